#include "sim/joint_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

MotorTargets zero_targets() {
  MotorTargets targets;
  targets.position = Eigen::VectorXd::Zero(nao_model()->num_motors());
  targets.stiffness = Eigen::VectorXd::Ones(nao_model()->num_motors());
  return targets;
}

TEST(JointCommand, SetsTheNamedJointsAndKeepsTheOthers) {
  MotorTargets targets = zero_targets();
  ASSERT_FALSE(merge_joint_command(
      *nao_model(), {0, {"LKneePitch", "HeadYaw"}, {0.5, -0.2}, {0.8, 0.0}}, targets));
  const int knee = nao_model()->find_motor("LKneePitch");
  EXPECT_EQ(targets.position[knee], 0.5);
  EXPECT_EQ(targets.stiffness[knee], 0.8);
  EXPECT_EQ(targets.position[nao_model()->find_motor("HeadYaw")], -0.2);
  EXPECT_EQ(targets.position.cwiseAbs().sum(), 0.7);
}

TEST(JointCommand, SetsGainsAndReturnsToTheServosOwn) {
  const double nan = std::nan("");
  const int head = nao_model()->find_motor("HeadYaw");
  const int knee = nao_model()->find_motor("LKneePitch");
  MotorTargets targets = zero_targets();
  const auto merge = [&](double kp, double kd) {
    return merge_joint_command(*nao_model(), {0, {"HeadYaw"}, {0}, {1}, {kp}, {kd}}, targets);
  };
  EXPECT_FALSE(merge(nan, nan));
  EXPECT_EQ(targets.kp.size(), 0);
  EXPECT_FALSE(merge(20, 0.5));
  EXPECT_EQ(targets.kp[head], 20);
  EXPECT_EQ(targets.kd[head], 0.5);
  EXPECT_TRUE(std::isnan(targets.kp[knee]));
  EXPECT_FALSE(merge(nan, nan));
  EXPECT_TRUE(std::isnan(targets.kp[head]));
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(merge(bad, 1));
    EXPECT_TRUE(merge(1, bad));
    EXPECT_TRUE(std::isnan(targets.kp[head]));
  }
}

TEST(JointCommand, RejectsAnInvalidMessageAsAWhole) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  struct {
    std::vector<std::string> names;
    std::vector<double> position;
    std::vector<double> stiffness;
    const char* complaint;
  } bad[] = {
      {{"HeadYaw", "Tail"}, {0.1, 0.1}, {1, 1}, "Tail"},
      {{"HeadYaw", "RHipYawPitch"}, {0.1, 0.1}, {1, 1}, "RHipYawPitch"},
      {{"HeadYaw", "HeadPitch"}, {0.1, nan}, {1, 1}, "HeadPitch"},
      {{"HeadYaw", "HeadPitch"}, {0.1, infinity}, {1, 1}, "HeadPitch"},
      {{"HeadYaw", "HeadPitch"}, {0.1, 0.1}, {1, 1.01}, "stiffness"},
      {{"HeadYaw", "HeadPitch"}, {0.1, 0.1}, {1, -0.1}, "stiffness"},
      {{"HeadYaw", "HeadPitch"}, {0.1, 0.1}, {1, nan}, "stiffness"},
      {{"HeadYaw", "HeadPitch"}, {0.1}, {1, 1}, "unequal"},
      {{"HeadYaw"}, {0.1}, {}, "unequal"},
  };
  for (const auto& message : bad) {
    MotorTargets targets = zero_targets();
    const auto reason = merge_joint_command(
        *nao_model(), {0, message.names, message.position, message.stiffness}, targets);
    ASSERT_TRUE(reason) << message.complaint;
    EXPECT_NE(reason->find(message.complaint), std::string::npos) << *reason;
    EXPECT_EQ(targets.position.cwiseAbs().sum(), 0) << *reason;
  }
}

}  // namespace
}  // namespace nao::sim
