#include "daemons/motion/falls/fall_monitor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/constants.h"

namespace nao::motion {
namespace {

constexpr double kLyingTilt = 1.0;

/** A robot on a square sole of 0.1 m, with its center of mass 0.25 m above the sole's center. */
RobotState standing_state() {
  RobotState state;
  state.left_foot_carries = true;
  state.support_polygon_in_odometry = {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}};
  state.center_of_mass_in_odometry = {0, 0, 0.25};
  return state;
}

/** Tilts torso and soles forward. */
void tilt(RobotState& state, double torso, double soles) {
  const auto pitch = [](double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  };
  state.torso_in_odometry.linear() = pitch(torso);
  state.left_sole_in_odometry.linear() = pitch(soles);
  state.right_sole_in_odometry.linear() = pitch(soles);
}

/** A robot whose capture point is `distance` m in front of the edge of its support polygon. */
RobotState pushed(double distance) {
  RobotState state = standing_state();
  const double omega = std::sqrt(kGravity / 0.25);
  state.center_of_mass_velocity_in_odometry.x() = (0.05 + distance) * omega;
  tilt(state, 0.2, 0.15);
  return state;
}

TEST(CapturePoint, IsTheCenterOfMassPlusVelocityOverTheNaturalFrequency) {
  RobotState state = standing_state();
  state.center_of_mass_in_odometry.head<2>() << 0.1, -0.2;
  state.center_of_mass_velocity_in_odometry = {0.3, 0.4, 9};
  const Eigen::Vector2d point = calc_capture_point(state);
  EXPECT_NEAR(point.x(), 0.1 + 0.3 * std::sqrt(0.25 / 9.81), 1e-12);
  EXPECT_NEAR(point.y(), -0.2 + 0.4 * std::sqrt(0.25 / 9.81), 1e-12);
}

TEST(FallMonitor, PredictsAFallWhenTheCapturePointStaysOutside) {
  FallMonitor monitor(kLyingTilt);
  EXPECT_FALSE(monitor.update(pushed(0.04), false, 0.01));
  EXPECT_FALSE(monitor.update(pushed(0.04), false, 0.01));
  EXPECT_TRUE(monitor.update(pushed(0.04), false, 0.01));
}

TEST(FallMonitor, CountsTimeAndNotSteps) {
  FallMonitor monitor(kLyingTilt);
  EXPECT_FALSE(monitor.update(pushed(0.04), false, 0.012));
  EXPECT_FALSE(monitor.update(pushed(0.04), false, 0.012));
  EXPECT_TRUE(monitor.update(pushed(0.04), false, 0.012));
  monitor.reset();
  EXPECT_TRUE(monitor.update(pushed(0.04), false, 0.03));
}

TEST(FallMonitor, APushFromWhichTheAnklesRecoverIsNoFall) {
  FallMonitor monitor(kLyingTilt);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(monitor.update(pushed(i % 3 == 2 ? -0.01 : 0.04), false, 0.01));
    EXPECT_FALSE(monitor.update(pushed(0.015), false, 0.01));
  }
}

TEST(FallMonitor, FastLimbsOfARobotOnFlatSolesAreNoFall) {
  FallMonitor monitor(kLyingTilt);
  RobotState state = pushed(0.1);
  tilt(state, 0.2, 0.05);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(monitor.update(state, false, 0.01));
}

TEST(FallMonitor, AWalkFallsByItsTiltAlone) {
  FallMonitor monitor(kLyingTilt);
  RobotState state = pushed(0.3);
  tilt(state, 0.34, 0.3);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(monitor.update(state, true, 0.01));
  tilt(state, 0.4, 0.3);
  EXPECT_TRUE(monitor.update(state, true, 0.01));
  // One that recovers from more.
  EXPECT_FALSE(monitor.update(state, true, 0.01, 0.6));
  tilt(state, 0.61, 0.3);
  EXPECT_TRUE(monitor.update(state, true, 0.01, 0.6));
}

TEST(FallMonitor, ARobotThatLiesFalls) {
  FallMonitor monitor(kLyingTilt);
  RobotState state = standing_state();
  tilt(state, 1.1, 0);
  EXPECT_TRUE(monitor.update(state, false, 0.01));
}

TEST(FallMonitor, ARobotInTheAirDoesNotFallByItsCapturePoint) {
  FallMonitor monitor(kLyingTilt);
  RobotState state = pushed(0.3);
  state.support_polygon_in_odometry.clear();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(monitor.update(state, false, 0.01));
}

}  // namespace
}  // namespace nao::motion
