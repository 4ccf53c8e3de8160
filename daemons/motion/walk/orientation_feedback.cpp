#include "daemons/motion/walk/orientation_feedback.h"

namespace nao::motion {

void add_orientation_feedback(const Gait::Orientation& gains, const LegKinematics& legs,
                              const WalkObserver& measured, bool support_is_left,
                              bool is_double_support, double tilt_scale,
                              std::vector<double>& offset) {
  const Eigen::Vector3d& rate = measured.angular_velocity();
  const Eigen::Vector3d& tilt = measured.tilt();
  // Angles in rad, in the sense of a rotation of the torso about y (pitch) and x (roll): a
  // proportional law on tilt, a derivative law on angular velocity.
  const double ankle_pitch =
      gains.gyro_ankle_pitch * rate.y() + tilt_scale * gains.tilt_ankle_pitch * tilt.y();
  const double ankle_roll =
      gains.gyro_ankle_roll * rate.x() + tilt_scale * gains.tilt_ankle_roll * tilt.x();
  // Joints of a leg that carries no weight do not move the torso: the swing leg is left out.
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const bool is_support = (leg == Leg::kLeft) == support_is_left;
    if (!is_support && !is_double_support) continue;
    const LegRoles& roles = legs.roles(leg);
    // roles.sign turns an angle about the torso's axis into the joint's own sense of rotation.
    const auto add = [&](int role, double angle) {
      if (role < 0) return;
      offset[legs.motors(leg)[role]] += roles.sign[role] * angle;
    };
    add(roles.hip_roll, gains.gyro_hip_roll * rate.x());
    add(roles.hip_pitch, gains.gyro_hip_pitch * rate.y());
    add(roles.ankle_pitch, ankle_pitch);
    add(roles.ankle_roll, ankle_roll);
  }
}

}  // namespace nao::motion
