#include "daemons/motion/standing_balance.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/falls/fall_monitor.h"
#include "kinematics/pose2.h"
#include "kinematics/support_polygon.h"

namespace nao::motion {
namespace {

// Velocity of the center of mass below which no push makes a robot step, m/s. Chosen: half of the
// least impulse for each kg that throws over a robot which does not step (nao-trial push-course).
constexpr double kPushVelocity = 0.2;

bool is_pushed(const RobotState& state) {
  return state.center_of_mass_velocity_in_odometry.head<2>().norm() >= kPushVelocity;
}

}  // namespace

// A robot that is lifted has no support polygon: its margin is NaN.
bool is_pushed_off(const RobotState& state, double margin) {
  return is_pushed(state) &&
         margin_in_polygon(state.support_polygon_in_odometry, calc_capture_point(state)) < -margin;
}

bool StandingBalance::must_step(const RobotState& state) const {
  if (!is_pushed(state)) return false;
  const double heading = heading_of(state.torso_in_odometry.linear());
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  const double capture_point = ahead.dot(calc_capture_point(state));
  // A robot that is lifted has no support polygon.
  const auto& corners = state.support_polygon_in_odometry;
  if (corners.empty()) return false;
  const auto [heel, toe] = std::ranges::minmax(
      corners, {}, [&](const Eigen::Vector2d& corner) { return ahead.dot(corner); });
  return ahead.dot(toe) - capture_point < gains_->step_margin ||
         capture_point - ahead.dot(heel) < gains_->step_margin;
}

void StandingBalance::add_to(const RobotState& state, std::vector<double>& position) const {
  const double measured = state.angular_velocity_torso.y();
  const double rate = measured - std::clamp(measured, -gains_->least_rate, gains_->least_rate);
  if (rate == 0) return;
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const LegRoles& roles = legs_->roles(leg);
    // roles.sign turns an angle about the torso's y axis into the joint's own sense of rotation.
    const auto add = [&](int role, double angle) {
      if (role < 0) return;
      position[legs_->motors(leg)[role]] += roles.sign[role] * angle;
    };
    add(roles.ankle_pitch, gains_->ankle_pitch * rate);
    add(roles.hip_pitch, gains_->hip_pitch * rate);
  }
}

}  // namespace nao::motion
