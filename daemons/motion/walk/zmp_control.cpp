#include "daemons/motion/walk/zmp_control.h"

#include "daemons/motion/walk/pendulum.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;

Vector2d clamp(const Vector2d& point, const Vector2d& lower, const Vector2d& upper) {
  return point.cwiseMax(lower).cwiseMin(upper);
}

}  // namespace

Vector2d clamp_to_sole(const Gait::Zmp& gait, const Vector2d& zmp, const Vector2d& nominal) {
  return clamp(zmp, nominal - Vector2d(gait.reach_backward, gait.reach_sideways),
               nominal + Vector2d(gait.reach_forward, gait.reach_sideways));
}

Vector2d control_single_support(const Gait::Zmp& gait, const Vector2d& nominal, const Vector2d& dcm,
                                const Vector2d& end_dcm, double omega, double remaining) {
  const Vector2d exact = zmp_between_dcms(dcm, end_dcm, omega, remaining);
  // gain 1 is the ZMP that brings the DCM exactly to the end point; it may be outside the sole.
  return clamp_to_sole(gait, nominal + gait.gain * (exact - nominal), nominal);
}

Vector2d control_double_support(const Gait::Zmp& gait, const Feet& feet, const Vector2d& dcm,
                                const Vector2d& goal, double omega, double remaining) {
  const Vector2d support = feet.support_zmp();
  const Vector2d other = feet.other_zmp();
  // Bounding rectangle of both nominal points in S, longer by the reach on a sole.
  const Vector2d backward(gait.reach_backward, 0);
  const Vector2d forward(gait.reach_forward, 0);
  return clamp(zmp_between_dcms(dcm, goal, omega, remaining), support.cwiseMin(other) - backward,
               support.cwiseMax(other) + forward);
}

}  // namespace nao::motion
