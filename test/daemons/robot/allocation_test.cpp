#include <gtest/gtest.h>

#include "daemons/robot/robot_core.h"
#include "test/daemons/robot/lola_nao.h"
#include "test/support/allocation_count.h"

namespace nao::robot {
namespace {

TEST(RobotCore, AllocatesNothing) {
  RobotCore core(nao_model(), nao_map(), true);
  LolaState frame = frame_of("Stand", 1);
  Targets command;
  command.position = nao_model().find_posture("Stand")->position;
  command.stiffness.assign(25, 1);
  core.take_frame(frame, 0);
  core.step({&command, true, false});
  const size_t before = allocation_count();
  for (int i = 0; i < 3000; ++i) {
    core.take_frame(frame, 1);
    const bool has_command = i < 1000 || i > 1500;
    core.step({has_command ? &command : nullptr, true, i > 2500});
  }
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(core.safety().phase(), Phase::kEnded);
}

}  // namespace
}  // namespace nao::robot
