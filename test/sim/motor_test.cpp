#include "sim/motor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/random.h"
#include "sim/world.h"
#include "test/sim/sim_fixture.h"
#include "test/sim/test_robots.h"

namespace nao::sim {
namespace {

/** A robot on a stand, in the air. */
class OnStand : public testing::Test {
 protected:
  OnStand() {
    RobotOptions options;
    options.is_on_stand = true;
    options.height = 0.5;
    options.command_latency_ticks = 0;
    options.ideal_sensors = true;
    robot_ = world_.add_robot(nao_model(), options);
  }

  void command(const char* joint, double angle, double stiffness = 1) {
    MotorTargets targets = world_.targets(robot_);
    const int motor = nao_model()->find_motor(joint);
    targets.position[motor] = angle;
    targets.stiffness[motor] = stiffness;
    world_.set_targets(robot_, targets);
  }
  double angle(const char* joint) const {
    return world_.robot(robot_).motor_position()[nao_model()->find_motor(joint)];
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds * 100); ++i) world_.step_tick();
  }

  World world_{SceneFile{}};
  int robot_;
};

TEST_F(OnStand, ServoReachesItsTarget) {
  command("HeadYaw", 1.0);
  run(2);
  // Dry friction may stop it before: friction torque over gain.
  const Motor& motor = nao_model()->motor(nao_model()->find_motor("HeadYaw"));
  EXPECT_NEAR(angle("HeadYaw"), 1.0, motor.dry_friction / motor.stiffness_gain + 1e-4);
}

TEST_F(OnStand, JointStopWithstandsTheMotor) {
  const Joint& joint = nao_model()->motor_joint(nao_model()->find_motor("LShoulderPitch"));
  command("LShoulderPitch", joint.upper + 3);
  double farthest = 0;
  for (int i = 0; i < 300; ++i) {
    run(0.01);
    farthest = std::max(farthest, angle("LShoulderPitch"));
  }
  EXPECT_GT(angle("LShoulderPitch"), joint.upper - 1e-4);
  EXPECT_LT(farthest, joint.upper + 0.02);
}

TEST_F(OnStand, RightHipYawPitchFollowsTheLeftExactly) {
  command("LHipYawPitch", -0.5);
  run(1);
  EXPECT_NEAR(angle("LHipYawPitch"), -0.5, 0.05);
  const auto yaw_of = [&](const char* link) {
    const Eigen::Matrix3d r = world_.robot(robot_).link_pose(nao_model()->find_link(link)).linear();
    return Eigen::AngleAxisd(r).angle();
  };
  EXPECT_NEAR(yaw_of("LPelvis"), yaw_of("RPelvis"), 1e-12);
}

TEST_F(OnStand, HandOpensAsAFirstOrderLag) {
  command("LHand", 0);
  run(2);
  EXPECT_NEAR(angle("LHand"), 0, 1e-3);
  command("LHand", 1);
  run(0.05);
  EXPECT_GT(angle("LHand"), 0.2);
  EXPECT_LT(angle("LHand"), 0.6);
  run(1);
  EXPECT_NEAR(angle("LHand"), 1, 1e-3);
}

TEST_F(OnStand, LimpJointHangsDown) {
  MotorTargets targets = world_.targets(robot_);
  targets.stiffness.setZero();
  world_.set_targets(robot_, targets);
  run(10);
  EXPECT_EQ(world_.robot(robot_).motor_torque().cwiseAbs().maxCoeff(), 0);
  // The arm hangs: hand below the shoulder.
  const auto height = [&](const char* link) {
    return world_.robot(robot_).link_pose(nao_model()->find_link(link)).translation().z();
  };
  EXPECT_LT(height("LWrist"), height("LShoulder") - 0.1);
}

TEST(Motors, StayWithinTheirTorqueSpeedLineInRandomMotion) {
  WorldOptions steps;
  steps.steps_per_tick = 1;
  World world{SceneFile{}, steps};
  RobotOptions options;
  options.command_latency_ticks = 0;
  const int robot = world.add_robot(nao_model(), options);
  Random random(11);
  MotorTargets targets = world.targets(robot);
  double worst = 0;
  int num_saturated = 0;
  for (int step = 0; step < 20000; ++step) {
    for (int i = 0; i < nao_model()->num_motors(); ++i) {
      if (step % 5 != 0 || random.uniform() > 0.03) continue;
      const Joint& joint = nao_model()->motor_joint(i);
      targets.position[i] = random.uniform(joint.lower, joint.upper);
      targets.stiffness[i] = random.uniform(0.1, 1);
    }
    world.set_targets(robot, targets);
    if (step % 1000 == 0) world.push(robot, 0, {3 * random.normal(), 3 * random.normal(), 0});
    const Eigen::VectorXd before = world.robot(robot).motor_velocity();
    world.step_tick();
    const SimRobot& it = world.robot(robot);
    for (int i = 0; i < nao_model()->num_motors(); ++i) {
      const Motor& motor = nao_model()->motor(i);
      const double torque = it.motor_torque()[i];
      // The torque is that of the mean speed of the step.
      const double speed = (before[i] + it.motor_velocity()[i]) / 2;
      const double peak = targets.stiffness[i] * motor.peak_torque;
      const bool is_driving = torque * speed > 0;
      const double line =
          is_driving ? peak * std::max(0.0, 1 - std::abs(speed) / motor.no_load_velocity) : peak;
      worst = std::max(worst, (std::abs(torque) - line) / motor.peak_torque);
      if (std::abs(torque) > 0.98 * line) ++num_saturated;
    }
  }
  EXPECT_GT(num_saturated, 5000);
  EXPECT_LT(worst, 0.01);
}

TEST(Motors, DoNotExceedTheirNoLoadSpeedByThemselves) {
  // A pendulum on a stand with the motor at its full torque.
  World world{SceneFile{}};
  RobotOptions options;
  options.posture = "Start";
  options.is_on_stand = true;
  options.height = 1;
  const int robot = world.add_robot(
      make_pendulum("{continuous_torque: 3, no_load_velocity: 2, reflected_inertia: 0.001, "
                    "dry_friction: 0, viscous_friction: 0, stiffness_gain: 500, damping_gain: 0}"),
      options);
  MotorTargets targets = world.targets(robot);
  targets.position[0] = 1.4;
  world.set_targets(robot, targets);
  double fastest = 0;
  for (int i = 0; i < 100; ++i) {
    world.step_tick();
    fastest = std::max(fastest, world.robot(robot).motor_velocity()[0]);
  }
  EXPECT_LT(fastest, 2.01);
  EXPECT_GT(fastest, 1);
}

TEST(Motors, FallFromPeakToContinuousTorqueWhenTheyAreHot) {
  Drive drive;
  drive.motor.peak_torque = 5;
  drive.motor.continuous_torque = 3;
  EXPECT_EQ(drive.torque_available(), 5);
  double seconds_at_peak = 0;
  for (int i = 0; i < 100000; ++i) {
    const double torque = drive.torque_available();
    if (torque > 4.99) seconds_at_peak += 0.01;
    drive.warm_up(torque, 0.01);
  }
  EXPECT_NEAR(drive.torque_available(), 3, 0.05);
  EXPECT_GT(seconds_at_peak, 5);
  EXPECT_LT(seconds_at_peak, 20);
  for (int i = 0; i < 10000; ++i) drive.warm_up(0, 0.01);
  EXPECT_EQ(drive.torque_available(), 5);
}

}  // namespace
}  // namespace nao::sim
