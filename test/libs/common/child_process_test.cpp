#include "common/child_process.h"

#include <gtest/gtest.h>

namespace nao {
namespace {

TEST(ChildProcess, ReportsTheExitStatusAndTheOutput) {
  ChildProcess child({"/bin/sh", "-c", "echo out; echo error >&2; exit 3"});
  EXPECT_EQ(child.wait(), 3);
  EXPECT_EQ(child.output(), "out\nerror\n");
}

TEST(ChildProcess, ReportsTheSignalThatEndedIt) {
  ChildProcess child({"/bin/sleep", "60"});
  EXPECT_EQ(child.end(SIGTERM), -SIGTERM);
}

TEST(ChildProcess, ReportsAMissingProgram) {
  EXPECT_EQ(ChildProcess({"/nowhere"}).wait(), 127);
}

TEST(ChildProcess, EndsWithTheObject) {
  pid_t pid = -1;
  {
    const ChildProcess child({"/bin/sleep", "60"});
    pid = child.pid();
  }
  EXPECT_NE(kill(pid, 0), 0);
}

}  // namespace
}  // namespace nao
