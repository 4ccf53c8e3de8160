#include "daemons/motion/standing_balance.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/falls/fall_monitor.h"
#include "daemons/motion/push_recovery.h"
#include "kinematics/pose2.h"

namespace nao::motion {

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
