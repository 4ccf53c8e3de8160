#include "daemons/motion/walk/foot_loads.h"

#include "common/constants.h"
#include "daemons/motion/walk/zmp_control.h"

namespace nao::motion {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

std::array<FootLoad, 2> plan_foot_loads(const Gait& gait, double mass, const Feet& feet,
                                        const ComReference& reference, const LoadPlan& plan,
                                        const Isometry3d& torso) {
  const Vector2d nominal = feet.support_zmp();
  // In double support the reference's ZMP lies between the feet; each foot then carries its part of
  // the load at its own nominal point.
  const Vector2d zmp = plan.is_double_support ? nominal : reference.zmp();
  // A weight that acts beyond the reference's ZMP accelerates the center of mass back: the DCM
  // error decays (tracking control of Englsberger et al. 2015).
  const Vector2d support_point =
      clamp_to_sole(gait.zmp, zmp + gait.feedback.ankle_dcm_gain * plan.dcm_error, nominal);
  const Vector2d other_point = feet.other_zmp();

  const double omega = reference.omega();
  // Ground reaction of the linear inverted pendulum, N, in S: m g upwards, and horizontally m
  // omega^2 (c - p), which accelerates the center of mass c away from the ZMP p.
  Vector3d force(0, 0, mass * kGravity);
  force.head<2>() = mass * omega * omega * (reference.state().position - reference.zmp());
  const Vector3d force_in_torso = torso.linear().transpose() * force;
  const Isometry3d to_torso = torso.inverse();
  // Both feet share the force in proportion to the planned load, as parallel forces.
  const FootLoad support{
      (1 - plan.other_load_ratio) * force_in_torso,
      to_torso * Vector3d(support_point.x(), support_point.y(), feet.support_height())};
  const FootLoad other{
      plan.other_load_ratio * force_in_torso,
      to_torso * Vector3d(other_point.x(), other_point.y(), feet.swing().height())};
  return feet.support_is_left() ? std::array<FootLoad, 2>{support, other}
                                : std::array<FootLoad, 2>{other, support};
}

}  // namespace nao::motion
