#include "sim/sensors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/world.h"
#include "test/sim/sim_fixture.h"

namespace nao::sim {
namespace {

using Eigen::Vector3d;

World& settled(World& world, double seconds) {
  for (int i = 0; i < std::lround(seconds * 100); ++i) world.step_tick();
  return world;
}

RobotOptions ideal() {
  RobotOptions options;
  options.ideal_sensors = true;
  return options;
}

TEST(FootSensors, CarryTheRobotsWeight) {
  World world{SceneFile{}};
  const int robot = world.add_robot(nao_model(), ideal());
  settled(world, 3);
  const double weight = 9.81 * world.robot(robot).tree().total_mass();
  EXPECT_NEAR(world.sensors(robot).foot_force.sum() / weight, 1, 1e-4);
  EXPECT_GE(world.sensors(robot).foot_force.minCoeff(), 0);
}

TEST(InertialUnit, MeasuresGravityAtRestAndNothingInFreeFall) {
  World world{SceneFile{}};
  const int standing = world.add_robot(nao_model(), ideal());
  settled(world, 3);
  const Vector3d at_rest = world.sensors(standing).accelerometer;
  EXPECT_NEAR(at_rest.norm(), 9.81, 1e-3);
  const Vector3d up = world.sensors(standing).orientation * at_rest;
  EXPECT_NEAR(up.z(), 9.81, 1e-3);

  World falling{SceneFile{}};
  RobotOptions options = ideal();
  options.height = 10;
  const int robot = falling.add_robot(nao_model(), options);
  settled(falling, 1);
  EXPECT_LT(falling.sensors(robot).accelerometer.norm(), 0.05);
}

TEST(InertialUnit, GyroscopeIntegratesToTheRotation) {
  World world{SceneFile{}};
  RobotOptions options = ideal();
  options.height = 3;
  const int robot = world.add_robot(nao_model(), options);
  world.push(robot, nao_model()->find_link("Head"), {0.3, 0.2, 0});
  world.push(robot, nao_model()->find_link("LWrist"), {0.2, 0, 0});
  Eigen::Quaterniond integrated = world.robot(robot).state().orientation;
  for (int i = 0; i < 60; ++i) {
    world.step_tick();
    const Vector3d turn = world.sensors(robot).gyroscope * 0.01;
    integrated = integrated * Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  }
  const Eigen::Quaterniond truth = world.robot(robot).state().orientation;
  EXPECT_GT(truth.angularDistance(Eigen::Quaterniond::Identity()), 0.3);
  EXPECT_LT(integrated.angularDistance(truth), 0.01);
}

TEST(Sensors, HaveTheSpecifiedResolutionNoiseAndBias) {
  World world{SceneFile{}};
  const int robot = world.add_robot(nao_model());
  settled(world, 2);
  const double step = 2 * M_PI / 4096;
  Vector3d sum = Vector3d::Zero();
  Vector3d squares = Vector3d::Zero();
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    world.step_tick();
    const SensorReadings& sensed = world.sensors(robot);
    for (int k = 0; k < sensed.position.size(); ++k) {
      const double steps = sensed.position[k] / step;
      ASSERT_NEAR(steps, std::round(steps), 1e-6);
      ASSERT_NEAR(sensed.position[k], world.robot(robot).motor_position()[k], step);
    }
    sum += sensed.gyroscope;
    squares += sensed.gyroscope.cwiseAbs2();
  }
  const SensorOptions expected;
  const Vector3d mean = sum / kSamples;
  const Vector3d deviation = (squares / kSamples - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(deviation[k] / expected.gyroscope_noise, 1, 0.1);
    EXPECT_LT(std::abs(mean[k]), 5 * expected.gyroscope_bias);
    EXPECT_GT(std::abs(mean[k]), 0);
  }
}

TEST(Sensors, EstimateRollAndPitchWhileTheHeadingDrifts) {
  World world{SceneFile{}};
  const int robot = world.add_robot(nao_model());
  settled(world, 300);
  const Eigen::Quaterniond error =
      world.sensors(robot).orientation * world.robot(robot).state().orientation.conjugate();
  const Vector3d up = error * Vector3d::UnitZ();
  EXPECT_LT(std::acos(up.z()), 0.05);
  const double heading = std::abs(2 * std::atan2(error.z(), error.w()));
  EXPECT_GT(heading, 0.01);
}

TEST(InertialUnit, MeasuresInItsOwnAxesWhereItIsMountedTilted) {
  World world{SceneFile{}};
  RobotOptions options;
  options.errors.imu_mount = {0.1, 0, 0};
  options.errors.accelerometer_scale = {1, 1, 2};
  options.errors.gyroscope_offset = {0, 0, 0.5};
  const int robot = world.add_robot(nao_model(), options);
  settled(world, 1);
  // Turned about x by 0.1 rad, the unit sees the vertical turned back.
  const Vector3d up(0, std::sin(0.1), std::cos(0.1));
  const Vector3d leaning = world.robot(robot).state().orientation.conjugate() * Vector3d::UnitZ();
  const Vector3d expected = (up + leaning - Vector3d::UnitZ()).cwiseProduct(Vector3d(1, 1, 2));
  EXPECT_NEAR((world.sensors(robot).accelerometer / 9.81 - expected).norm(), 0, 0.06);
  EXPECT_NEAR(world.sensors(robot).gyroscope.z(), 0.5, 0.05);
}

TEST(InertialUnit, RefreshesItsHalvesInTurns) {
  World world{SceneFile{}};
  RobotOptions options;
  options.errors.imu_alternates = true;
  const int robot = world.add_robot(nao_model(), options);
  SensorReadings last = world.sensors(robot);
  EXPECT_TRUE(last.is_accelerometer_new && last.is_gyroscope_new);
  for (int i = 0; i < 20; ++i) {
    world.step_tick();
    const SensorReadings& now = world.sensors(robot);
    EXPECT_NE(now.is_accelerometer_new, now.is_gyroscope_new);
    EXPECT_EQ(now.is_accelerometer_new, now.accelerometer != last.accelerometer);
    EXPECT_EQ(now.is_gyroscope_new, now.gyroscope != last.gyroscope);
    EXPECT_TRUE(i == 0 || now.is_gyroscope_new != last.is_gyroscope_new);
    last = now;
  }
}

TEST(FootSensors, MayBeDeadOrOfAnotherScale) {
  World world{SceneFile{}};
  const int ideal_robot = world.add_robot(nao_model(), ideal());
  World other{SceneFile{}};
  RobotOptions options;
  options.errors.foot_sensor_scale = Eigen::VectorXd::Constant(8, 0.7);
  options.errors.foot_sensor_scale[2] = 0;
  const int robot = other.add_robot(nao_model(), options);
  settled(world, 1);
  settled(other, 1);
  const Eigen::VectorXd& force = other.sensors(robot).foot_force;
  EXPECT_EQ(force[2], 0);
  EXPECT_NEAR(force[0], 0.7 * world.sensors(ideal_robot).foot_force[0], 0.5);
}

TEST(Losses, AreAsFrequentAsTheOptionsSayAndALostCommandChangesNothing) {
  World world{SceneFile{}};
  RobotOptions options;
  options.errors.sensor_loss = 0.2;
  options.errors.command_loss = 0.1;
  const int robot = world.add_robot(nao_model(), options);
  MotorTargets targets = world.targets(robot);
  int num_lost_readings = 0;
  int num_lost_targets = 0;
  constexpr int kTicks = 2000;
  for (int i = 0; i < kTicks; ++i) {
    world.step_tick();
    num_lost_readings += world.are_readings_lost(robot) ? 1 : 0;
    targets.position[0] = 1e-6 * i;
    world.set_targets(robot, targets);
    num_lost_targets += world.targets(robot).position[0] == targets.position[0] ? 0 : 1;
  }
  // Four standard deviations of the binomial distribution.
  EXPECT_NEAR(num_lost_readings, 0.2 * kTicks, 72);
  EXPECT_NEAR(num_lost_targets, 0.1 * kTicks, 54);
}

}  // namespace
}  // namespace nao::sim
