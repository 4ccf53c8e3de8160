#include <gtest/gtest.h>

#include <cmath>

#include "common/constants.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

class BacklashTest : public testing::Test {
 protected:
  /** A robot on a stand whose gears have 2 degrees of play. */
  World& world(double play = 2 * kDegree) {
    RobotOptions options;
    options.is_on_stand = true;
    options.height = 0.5;
    options.ideal_sensors = true;
    options.command_latency_ticks = 0;
    options.errors.backlash = Eigen::VectorXd::Constant(nao_model()->num_motors(), play);
    world_.add_robot(nao_model(), options);
    return world_;
  }
  double link(const std::string& joint) const {
    return world_.robot(0).motor_position()[nao_model()->find_motor(joint)];
  }
  double encoder(const std::string& joint) const {
    return world_.sensors(0).position[nao_model()->find_motor(joint)];
  }

  World world_{SceneFile{}};
};

TEST_F(BacklashTest, LetsTheLinkHangOnTheFlankThatCarriesIt) {
  World& world = this->world();
  for (int i = 0; i < 300; ++i) world.step_tick();
  // Stretched ahead, an arm's weight turns the shoulder to greater angles (downwards): the motor
  // holds it from the other side, one half of the play behind.
  MotorTargets targets = world.targets(0);
  targets.position[nao_model()->find_motor("LShoulderPitch")] = 0;
  world.set_targets(0, targets);
  for (int i = 0; i < 300; ++i) world.step_tick();
  EXPECT_NEAR(link("LShoulderPitch") - encoder("LShoulderPitch"), 1 * kDegree, 1e-9);
}

TEST_F(BacklashTest, NeverMovesTheLinkOutOfThePlay) {
  World& world = this->world();
  MotorTargets targets = world.targets(0);
  const Eigen::VectorXd start = targets.position;
  for (int i = 0; i < 500; ++i) {
    for (int k = 0; k < start.size(); ++k) {
      targets.position[k] = start[k] + 0.2 * std::sin(0.01 * i * (3 + k));
    }
    world.set_targets(0, targets);
    world.step_tick();
    for (int k = 0; k < start.size(); ++k) {
      if (world.robot(0).is_opening(k)) continue;
      const double offset = world.sensors(0).position[k] - world.robot(0).motor_position()[k];
      ASSERT_LE(std::abs(offset), 1 * kDegree + 1e-9) << nao_model()->motor_names()[k];
    }
  }
  EXPECT_EQ(world.num_bad_states(), 0);
}

TEST(Backlash, OfAStandingRobotIsSolvedInEachStep) {
  World world{SceneFile{}};
  RobotOptions options;
  options.errors.backlash = Eigen::VectorXd::Constant(nao_model()->num_motors(), 0.5 * kDegree);
  world.add_robot(nao_model(), options);
  MotorTargets targets = world.targets(0);
  const double middle = targets.position[nao_model()->find_motor("LAnklePitch")];
  int most = 0;
  for (int i = 0; i < 500; ++i) {
    for (const char* ankle : {"LAnklePitch", "RAnklePitch"}) {
      targets.position[nao_model()->find_motor(ankle)] = middle + 0.03 * std::sin(0.1 * i);
    }
    world.set_targets(0, targets);
    world.step_tick();
    most = std::max(most, world.last_iterations());
  }
  EXPECT_LT(most, 50);
}

TEST_F(BacklashTest, HardlyChangesTheMotionWhereItIsTiny) {
  World& tiny = world(1e-6 * kDegree);
  World exact{SceneFile{}};
  RobotOptions options;
  options.is_on_stand = true;
  options.height = 0.5;
  options.ideal_sensors = true;
  options.command_latency_ticks = 0;
  exact.add_robot(nao_model(), options);
  MotorTargets targets = exact.targets(0);
  const Eigen::VectorXd start = targets.position;
  double largest = 0;
  for (int i = 0; i < 300; ++i) {
    for (int k = 0; k < start.size(); ++k) {
      targets.position[k] = start[k] + 0.2 * std::sin(0.01 * i * 6);
    }
    tiny.set_targets(0, targets);
    exact.set_targets(0, targets);
    tiny.step_tick();
    exact.step_tick();
    const Eigen::VectorXd off = tiny.robot(0).motor_position() - exact.robot(0).motor_position();
    largest = std::max(largest, off.cwiseAbs().maxCoeff());
  }
  // A flank that changes is free for a step: the link moves on alone for 2 ms.
  EXPECT_LT(largest, 0.3 * kDegree);
}

TEST(JointZero, ShiftsTheReadingAndTheAngleThatTheServoHolds) {
  World world{SceneFile{}};
  RobotOptions options;
  options.is_on_stand = true;
  options.height = 0.5;
  options.ideal_sensors = true;
  options.errors.joint_zero = Eigen::VectorXd::Zero(nao_model()->num_motors());
  const int knee = nao_model()->find_motor("LKneePitch");
  options.errors.joint_zero[knee] = 2 * kDegree;
  world.add_robot(nao_model(), options);
  const double target = world.targets(0).position[knee];
  for (int i = 0; i < 300; ++i) world.step_tick();
  EXPECT_NEAR(world.sensors(0).position[knee], target, 0.3 * kDegree);
  EXPECT_NEAR(world.robot(0).motor_position()[knee], target - 2 * kDegree, 0.3 * kDegree);
}

}  // namespace
}  // namespace nao::sim
