#include "daemons/motion/push_recovery.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/falls/fall_monitor.h"
#include "kinematics/pose2.h"
#include "kinematics/support_polygon.h"
#include "policy/command_ramp.h"

namespace nao::motion {
namespace {

// Velocity of the center of mass below which no push makes a robot step, m/s. Chosen: half of the
// least impulse for each kg that throws over a robot which does not step (nao-trial push-course).
constexpr double kPushVelocity = 0.2;

// A walk by the gait does not recover from a capture point that is farther beyond a foot's outer
// edge, or beyond the soles in any direction, than these fractions of the center of mass's height.
// To the second one the distance is added that the robot walks in kWalkTime, s, since a fast walk's
// capture point leaves the soles without a push. Chosen (nao-trial push-course, joystick and
// sprint, T1): less takes walks over that would have gone on, more is too late.
constexpr double kWalkOutwardMargin = 0.04;
constexpr double kWalkMargin = 0.15;
constexpr double kWalkTime = 0.3;

}  // namespace

Eigen::Vector2d left_of(const RobotState& state) {
  const double heading = heading_of(state.torso_in_odometry.linear());
  return {-std::sin(heading), std::cos(heading)};
}

bool is_pushed(const RobotState& state) {
  return state.center_of_mass_velocity_in_odometry.head<2>().norm() >= kPushVelocity;
}

// A robot that is lifted has no support polygon: its margin is NaN.
bool is_pushed_off(const RobotState& state, double margin) {
  return is_pushed(state) &&
         margin_in_polygon(state.support_polygon_in_odometry, calc_capture_point(state)) < -margin;
}

bool is_pushed_at_rest(const RobotState& state) {
  return state.left_foot_carries && state.right_foot_carries && is_pushed_off(state, 0);
}

double recovery_lead(const RobotState& state) {
  const bool is_left = left_of(state).dot(state.center_of_mass_velocity_in_odometry.head<2>()) > 0;
  return is_left ? 0 : kRightLead;
}

std::optional<double> find_outward_lead(const RobotState& state, double margin) {
  const auto& corners = state.support_polygon_in_odometry;
  if (corners.empty()) return std::nullopt;
  const Eigen::Vector2d left = left_of(state);
  const double capture = left.dot(calc_capture_point(state));
  const double distance = margin * state.center_of_mass_in_odometry.z();
  const auto [rightmost, leftmost] = std::ranges::minmax(
      corners, {}, [&](const Eigen::Vector2d& corner) { return left.dot(corner); });
  if (state.left_foot_carries && capture - left.dot(leftmost) > distance) return 0;
  if (state.right_foot_carries && left.dot(rightmost) - capture > distance) return kRightLead;
  return std::nullopt;
}

bool is_walk_pushed(const RobotState& state, const Eigen::Vector3d& velocity) {
  // The capture point runs ahead of a walk by what its next step makes up for.
  const Eigen::Rotation2Dd heading(heading_of(state.torso_in_odometry.linear()));
  RobotState relative = state;
  relative.center_of_mass_velocity_in_odometry.head<2>() -= heading * velocity.head<2>();
  const double margin =
      kWalkMargin * state.center_of_mass_in_odometry.z() + kWalkTime * velocity.head<2>().norm();
  return find_outward_lead(relative, kWalkOutwardMargin) || is_pushed_off(relative, margin);
}

}  // namespace nao::motion
