#include "daemons/motion/guards/joint_change_guard.h"

#include <gmock/gmock.h>

#include "test/daemons/motion/robot_at_rest.h"

namespace nao::motion {
namespace {

JointChangeCommand change(std::vector<std::string> joints, std::vector<double> angles) {
  return {std::move(joints), std::move(angles), true, 1, false};
}

class JointChangeGuardTest : public ::testing::Test {
 protected:
  std::optional<Reason> find_danger(const JointChangeCommand& command) {
    return guard_.find_danger(command, robot_.context(), robot_.targets());
  }

  RobotAtRest robot_;
  JointChangeGuard guard_{nao_model()};
};

TEST_F(JointChangeGuardTest, LetsAHeadTurn) {
  EXPECT_EQ(find_danger(change({"HeadYaw"}, {1})), std::nullopt);
}

TEST_F(JointChangeGuardTest, TellsTheDirectionInWhichAChangeTips) {
  EXPECT_EQ(find_danger(change({"LHipPitch", "RHipPitch"}, {0.9, 0.9}))->code, "tipping-backward");
  EXPECT_EQ(find_danger(change({"LHipPitch", "RHipPitch"}, {-0.9, -0.9}))->code, "tipping-forward");
}

TEST_F(JointChangeGuardTest, NamesTheLegJointAndHowFarItMayTurn) {
  const auto danger = find_danger(change({"HeadYaw", "LHipPitch", "RHipPitch"}, {1.5, 0.9, 0.9}));
  ASSERT_TRUE(danger);
  ASSERT_EQ(danger->arguments.size(), 2u);
  EXPECT_THAT(danger->arguments[0], testing::EndsWith("HipPitch"));
  const int degrees = std::stoi(danger->arguments[1]);
  EXPECT_GT(degrees, 0);
  EXPECT_LT(degrees, 0.9 * 180 / M_PI);
}

TEST_F(JointChangeGuardTest, ChecksNoTippingIfTheCommandAllowsIt) {
  JointChangeCommand command = change({"LHipPitch", "RHipPitch"}, {0.9, 0.9});
  command.allow_tipping = true;
  EXPECT_EQ(find_danger(command), std::nullopt);
}

TEST_F(JointChangeGuardTest, ChecksNoTippingOfARobotThatSits) {
  robot_ = RobotAtRest("Sit");
  EXPECT_EQ(find_danger(change({"LHipPitch", "RHipPitch"}, {0.3, 0.3})), std::nullopt);
}

TEST_F(JointChangeGuardTest, TellsWhatCollides) {
  JointChangeCommand command = change(
      {"LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll"}, {1.4, -0.31, -1.0, -1.5});
  command.is_relative = false;
  const auto danger = find_danger(command);
  ASSERT_TRUE(danger);
  EXPECT_EQ(danger->code, "self-collision");
  EXPECT_EQ(danger->arguments.size(), 4u);
}

}  // namespace
}  // namespace nao::motion
