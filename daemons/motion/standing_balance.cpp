#include "daemons/motion/standing_balance.h"

#include <algorithm>

namespace nao::motion {

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
