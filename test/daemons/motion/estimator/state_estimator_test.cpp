#include "daemons/motion/estimator/state_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "common/constants.h"
#include "test/daemons/motion/nao_variant.h"
#include "test/daemons/motion/perfect_robot.h"

namespace nao::motion {
namespace {

Sensors standing(const std::string& posture, double pitch) {
  Sensors sensors = PerfectRobot(posture).sensors();
  sensors.accelerometer_torso =
      Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitY()) * Eigen::Vector3d(0, 0, kGravity);
  return sensors;
}

TEST(StateEstimator, StandingPosturesHaveThePublishedHeights) {
  // Facts sheet, table of standing postures: torso height m, pitch forward rad.
  const struct {
    const char* posture;
    double height;
    double pitch;
  } rows[] = {{"StandZero", 0.333, 0}, {"StandInit", 0.320, 0.1}, {"Crouch", 0.229, -0.06}};
  for (const auto& row : rows) {
    StateEstimator estimator(nao_model());
    estimator.update(standing(row.posture, row.pitch), 0.01);
    EXPECT_NEAR(estimator.state().torso_in_odometry.translation().z(), row.height, 1e-3)
        << row.posture;
    EXPECT_GT(estimator.state().balance_margin, 0.03) << row.posture;
    EXPECT_NEAR(estimator.state().torso_in_odometry.translation().head<2>().norm(), 0, 1e-9);
  }
}

TEST(StateEstimator, FollowsATurnAndLearnsTheBias) {
  StateEstimator estimator(nao_model());
  Sensors sensors = standing("StandInit", 0.1);
  const Eigen::Vector3d bias(0.01, -0.02, 0.015);
  sensors.gyroscope_torso = bias;
  for (int i = 0; i < 1000; ++i) estimator.update(sensors, 0.01);
  EXPECT_NEAR(estimator.state().angular_velocity_torso.norm(), 0, 1e-4);
  const Eigen::Matrix3d R = estimator.state().torso_in_odometry.linear();
  EXPECT_NEAR(std::asin(-R(2, 0)), 0.1, 2e-3);
  const double heading = std::atan2(R(1, 0), R(0, 0));
  sensors.gyroscope_torso = bias + R.transpose() * Eigen::Vector3d(0, 0, 1.0);
  for (int i = 0; i < 50; ++i) estimator.update(sensors, 0.01);
  const Eigen::Matrix3d turned = estimator.state().torso_in_odometry.linear();
  EXPECT_NEAR(std::atan2(turned(1, 0), turned(0, 0)) - heading, 0.5, 5e-3);
}

// An offset of 4 degrees/s: B-Human 2025 met above 3.
TEST(StateEstimator, LearnsABiasAboveTheAngularVelocityOfARest) {
  StateEstimator estimator(nao_model());
  Sensors sensors = standing("StandInit", 0);
  sensors.gyroscope_torso = {0.01, 0.07, -0.02};
  for (int i = 0; i < 170; ++i) estimator.update(sensors, 0.01);
  EXPECT_NEAR(estimator.state().angular_velocity_torso.norm(), 0, 1e-3);
  // Once it is known, a slow turn is no bias.
  sensors.gyroscope_torso.z() += 0.07;
  for (int i = 0; i < 200; ++i) estimator.update(sensors, 0.01);
  EXPECT_NEAR(estimator.state().angular_velocity_torso.z(), 0.07, 1e-3);
}

// As a robot does after it was put down: its mean over a part of a swing would be taken for the
// bias.
TEST(StateEstimator, LearnsNoBiasFromASway) {
  for (const double amplitude : {0.065, 0.1}) {
    StateEstimator estimator(nao_model());
    Sensors sensors = standing("StandInit", 0);
    for (int i = 0; i < 300; ++i) {
      sensors.gyroscope_torso.y() = amplitude * std::cos(2 * std::numbers::pi * 0.01 * i);
      estimator.update(sensors, 0.01);
      const double rate = estimator.state().angular_velocity_torso.y();
      ASSERT_LT(std::abs(sensors.gyroscope_torso.y() - rate), 0.02) << amplitude << ", " << i;
    }
  }
}

TEST(StateEstimator, UsesTheInertialUnitsOrientationWhenItStartsInAFall) {
  // In free fall the accelerometer measures almost nothing, in any direction.
  StateEstimator estimator(nao_model());
  Sensors sensors = standing("StandInit", 0);
  sensors.accelerometer_torso = {0.1, 0.2, -0.1};
  sensors.orientation_torso_in_world = Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) *
                                       Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitY());
  estimator.update(sensors, 0.01);
  const Eigen::Matrix3d R = estimator.state().torso_in_odometry.linear();
  EXPECT_NEAR(std::asin(-R(2, 0)), 1.2, 1e-6);
  EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)), 0, 1e-6);
}

TEST(StateEstimator, CenterOfPressureFollowsTheLoadedCorner) {
  StateEstimator estimator(nao_model());
  Sensors sensors = standing("StandZero", 0);
  sensors.foot_force = {0, 0, 0, 0, 0, 0, 0, 50};
  estimator.update(sensors, 0.01);
  const RobotState& state = estimator.state();
  EXPECT_FALSE(state.left_foot_carries);
  EXPECT_TRUE(state.right_foot_carries);
  EXPECT_NEAR(state.center_of_pressure_in_odometry.x(), -0.03025, 1e-6);
  EXPECT_NEAR(state.center_of_pressure_in_odometry.y(), -0.05 - 0.0299, 1e-6);
  sensors.foot_force.assign(8, 0);
  estimator.update(sensors, 0.01);
  EXPECT_TRUE(std::isnan(estimator.state().center_of_pressure_in_odometry.x()));
  EXPECT_TRUE(std::isnan(estimator.state().balance_margin));
}

/** Sensors of a robot with other foot force sensors than the NAO's. */
Sensors standing_with_forces(std::vector<double> foot_force) {
  Sensors sensors = standing("StandZero", 0);
  sensors.foot_force = std::move(foot_force);
  return sensors;
}

TEST(StateEstimator, TakesAnyNumberOfForceSensorsPerFoot) {
  // One on the left foot, three on the right one, in any order.
  const RobotModel model = load_nao_variant("foot_sensors", "[RFsrFL, LFsrFR, RFsrRL, RFsrRR]");
  StateEstimator estimator(model);
  estimator.update(standing_with_forces({5, 20, 6, 7}), 0.01);
  const RobotState& state = estimator.state();
  EXPECT_DOUBLE_EQ(state.left_foot_force, 20);
  EXPECT_DOUBLE_EQ(state.right_foot_force, 18);
  EXPECT_TRUE(state.left_foot_carries);
  EXPECT_TRUE(state.right_foot_carries);
}

TEST(StateEstimator, WithOneForceSensorPerFootTheCenterOfPressureIsBetweenThem) {
  const RobotModel model = load_nao_variant("foot_sensors", "[LFsrFL, RFsrFL]");
  StateEstimator estimator(model);
  estimator.update(standing_with_forces({10, 30}), 0.01);
  Kinematics kinematics(model);
  kinematics.update(nao_posture("StandZero"));
  const auto sensor = [&](const char* name) -> Eigen::Vector3d {
    return kinematics.link_pose(model.find_link(name)).translation();
  };
  const Eigen::Vector3d expected = 0.25 * sensor("LFsrFL") + 0.75 * sensor("RFsrFL");
  const RobotState& state = estimator.state();
  EXPECT_LT((state.center_of_pressure_in_odometry - (state.torso_in_odometry * expected).head<2>())
                .norm(),
            1e-9);
}

TEST(StateEstimator, TellsContactFromTorquesIfAFootHasNoForceSensor) {
  for (const char* sensors : {"[]", "[LFsrFL, LFsrFR]"}) {
    const RobotModel model = load_nao_variant("foot_sensors", sensors);
    StateEstimator estimator(model);
    // Stretched legs without torque stand: the force along them is the weight.
    estimator.update(standing_with_forces(std::vector<double>(model.foot_sensors().size(), 0)),
                     0.01);
    const RobotState& state = estimator.state();
    EXPECT_TRUE(state.left_foot_carries) << sensors;
    EXPECT_TRUE(state.right_foot_carries) << sensors;
    EXPECT_NEAR(state.left_foot_force + state.right_foot_force, model.total_mass() * kGravity,
                0.1 * model.total_mass() * kGravity)
        << sensors;
  }
}

TEST(StateEstimator, LyingOnTheBackTheTorsoIsAsHighAsTheBackIsDeep) {
  StateEstimator estimator(nao_model());
  Sensors sensors = standing("StandZero", -M_PI / 2);
  estimator.update(sensors, 0.01);
  const double height = estimator.state().torso_in_odometry.translation().z();
  EXPECT_GT(height, 0.04);
  EXPECT_LT(height, 0.09);
}

}  // namespace
}  // namespace nao::motion
