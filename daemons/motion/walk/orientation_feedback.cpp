#include "daemons/motion/walk/orientation_feedback.h"

namespace nao::motion {

void add_orientation_feedback(const Gait::Orientation& gains, const LegKinematics& legs,
                              const WalkObserver& measured, bool support_is_left,
                              bool is_double_support, double tilt_scale,
                              std::vector<double>& offset) {
  const Eigen::Vector3d& rate = measured.angular_velocity();
  const Eigen::Vector3d& tilt = measured.tilt();
  const double ankle_pitch =
      gains.gyro_ankle_pitch * rate.y() + tilt_scale * gains.tilt_ankle_pitch * tilt.y();
  const double ankle_roll =
      gains.gyro_ankle_roll * rate.x() + tilt_scale * gains.tilt_ankle_roll * tilt.x();
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const bool is_support = (leg == Leg::kLeft) == support_is_left;
    if (!is_support && !is_double_support) continue;
    const LegRoles& roles = legs.roles(leg);
    const auto add = [&](int role, double angle) {
      offset[legs.motors(leg)[role]] += roles.sign[role] * angle;
    };
    add(roles.hip_roll, gains.gyro_hip_roll * rate.x());
    add(roles.hip_pitch, gains.gyro_hip_pitch * rate.y());
    add(roles.ankle_pitch, ankle_pitch);
    add(roles.ankle_roll, ankle_roll);
  }
}

}  // namespace nao::motion
