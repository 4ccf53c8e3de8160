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

}  // namespace
}  // namespace nao::sim
