#include "daemons/motion/commands/acceptance.h"

#include <gtest/gtest.h>

#include "messages/mode.h"

namespace nao::motion {
namespace {

TEST(Acceptance, WithoutARobotEveryCommandIsRefused) {
  for (int kind = 0; kind < kNumCommandKinds; ++kind) {
    EXPECT_EQ(find_mode_obstacle(static_cast<CommandKind>(kind), Mode::kNoRobot),
              Reason("no-robot"));
  }
}

TEST(Acceptance, EveryRefusalHasAReason) {
  for (int kind = 0; kind < kNumCommandKinds; ++kind) {
    for (int mode = 0; mode < kNumModes; ++mode) {
      const auto obstacle =
          find_mode_obstacle(static_cast<CommandKind>(kind), static_cast<Mode>(mode));
      if (!obstacle) continue;
      EXPECT_FALSE(obstacle->empty()) << to_string(static_cast<CommandKind>(kind)) << " in "
                                      << to_string(static_cast<Mode>(mode));
    }
  }
}

TEST(Acceptance, RelaxedJointsDoNotTurnAndAFallenRobotDoesNotWalk) {
  EXPECT_EQ(find_mode_obstacle(CommandKind::kJointChange, Mode::kRelaxed), Reason("robot-relaxed"));
  EXPECT_EQ(find_mode_obstacle(CommandKind::kWalk, Mode::kFallen), Reason("robot-fallen"));
  EXPECT_EQ(find_mode_obstacle(CommandKind::kPosture, Mode::kFallen), std::nullopt);
}

TEST(Acceptance, AStopInterruptsGettingUpButNoFall) {
  EXPECT_EQ(find_mode_obstacle(CommandKind::kStop, Mode::kGettingUp), std::nullopt);
  EXPECT_EQ(find_mode_obstacle(CommandKind::kStop, Mode::kFalling), Reason("robot-falling"));
}

}  // namespace
}  // namespace nao::motion
