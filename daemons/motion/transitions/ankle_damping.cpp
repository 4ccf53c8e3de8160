#include "daemons/motion/transitions/ankle_damping.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

// Greatest angle that is added to an ankle, rad. Chosen: it moves the center of pressure to the
// edge of a sole, also with soft servos.
constexpr double kGreatestAngle = 0.4;

}  // namespace

void AnkleDamping::add_to(const RobotState& state, double gain, double dt,
                          std::vector<double>& position) {
  kinematics_.update(position);
  // The sum of the soles' normals, in the torso frame, is the direction of up over flat soles, also
  // with legs that are spread.
  const Eigen::Vector3d up =
      kinematics_.left_sole().linear().col(2) + kinematics_.right_sole().linear().col(2);
  const double pitch = std::atan2(-up.x(), up.z());
  const double rate = last_pitch_ && dt > 0 ? (pitch - *last_pitch_) / dt : 0;
  last_pitch_ = pitch;
  if (gain == 0) return;
  const double angle =
      std::clamp(gain * (state.angular_velocity_torso.y() - rate), -kGreatestAngle, kGreatestAngle);
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const LegRoles& roles = legs_.roles(leg);
    if (roles.ankle_pitch < 0) continue;
    // roles.sign turns an angle about the torso's y axis into the joint's own sense of rotation.
    position[legs_.motors(leg)[roles.ankle_pitch]] += roles.sign[roles.ankle_pitch] * angle;
  }
}

}  // namespace nao::motion
