#include "daemons/motion/transitions/body_state.h"

#include <gtest/gtest.h>

#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

constexpr double kLyingTilt = 1.0;

std::string state_of(const RobotAtRest& robot) {
  return find_body_state(nao_model(), robot.state(), kLyingTilt);
}

TEST(BodyState, AStandOrCrouchIsOnTheFeet) {
  for (const char* posture : {"StandZero", "StandInit", "Stand", "Crouch"}) {
    EXPECT_EQ(state_of(RobotAtRest(posture)), "on-feet") << posture;
  }
}

TEST(BodyState, ASeatIsTheNearestSittingPosture) {
  EXPECT_EQ(state_of(RobotAtRest("Sit")), "Sit");
  EXPECT_TRUE(is_sitting(nao_model(), "Sit"));
  EXPECT_FALSE(is_sitting(nao_model(), "on-feet"));
}

TEST(BodyState, ALyingRobotIsOnTheSideThatIsDown) {
  const struct {
    Eigen::Vector3d up_in_torso;
    const char* side;
  } rows[] = {
      {{1, 0, 0}, "back"}, {{-1, 0, 0}, "belly"}, {{0, -1, 0}, "left"}, {{0, 1, 0}, "right"}};
  for (const auto& row : rows) {
    RobotAtRest robot("StandZero");
    robot.lay_down(row.up_in_torso);
    EXPECT_EQ(state_of(robot), row.side);
    EXPECT_TRUE(is_lying(robot.state(), kLyingTilt));
  }
}

TEST(BodyState, ARobotHeldInTheAirIsInNoState) {
  RobotAtRest robot("StandInit");
  robot.sensors().foot_force.assign(robot.sensors().foot_force.size(), 0);
  robot.measure();
  EXPECT_EQ(state_of(robot), "");
}

TEST(PresentPosture, NeedsTheJointsAndTheBody) {
  RobotAtRest robot("Crouch");
  const auto present = [&] {
    return find_present_posture(nao_model(), robot.sensors().position, robot.state(),
                                MotionOptions());
  };
  ASSERT_NE(present(), nullptr);
  EXPECT_EQ(present()->name, "Crouch");
  robot.lay_down({1, 0, 0});
  EXPECT_EQ(present(), nullptr);
  robot = RobotAtRest("Crouch");
  robot.sensors().position[nao_motor("LKneePitch")] -= 0.2;
  robot.measure();
  EXPECT_EQ(present(), nullptr);
}

}  // namespace
}  // namespace nao::motion
