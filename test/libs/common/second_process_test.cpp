#include "common/second_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <naolcm/daemon_status_t.hpp>

namespace nao {
namespace {

class SecondProcessTest : public testing::Test {
 protected:
  void hear(const std::string& program, const std::string& host, int process) {
    naolcm::daemon_status_t status{};
    status.program = program;
    status.host = host;
    status.process_id = process;
    bus_.publish("DAEMON_STATUS", status);
    while (bus_.handle_for(0)) {
    }
  }

  Bus bus_{"memq://"};
  double now_ = 10;
  SecondProcess second_{bus_, "nao-sim", [this] { return now_; }};
};

TEST_F(SecondProcessTest, IsNamedUntilItIsSilent) {
  hear("nao-sim", "pc", 12);
  EXPECT_EQ(second_.describe(), "a second nao-sim is on this bus: host pc, process 12");
  now_ += 3;
  EXPECT_EQ(second_.describe(), "");
}

TEST_F(SecondProcessTest, IsNeitherThisOneNorAnotherProgram) {
  std::array<char, 256> host{};
  ASSERT_EQ(gethostname(host.data(), host.size() - 1), 0);
  hear("nao-sim", host.data(), getpid());
  hear("nao-motion", "pc", 12);
  EXPECT_EQ(second_.describe(), "");
  // A process id says nothing about another host.
  hear("nao-sim", "pc", getpid());
  EXPECT_NE(second_.describe(), "");
}

}  // namespace
}  // namespace nao
