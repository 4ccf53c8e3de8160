#pragma once

#include <Eigen/Core>

namespace nao {

/** Greatest change of the velocity that a policy is commanded, m/s^2 and rad/s^2. Chosen: other
 * people's policies are trained with jumps; less is gentler. */
inline const Eigen::Vector3d kPolicyAcceleration(1, 1, 2);

/** @return The commanded velocity, m/s and rad/s, after a time dt, s, on its way to a goal. */
inline Eigen::Vector3d ramp_command(const Eigen::Vector3d& command, const Eigen::Vector3d& goal,
                                    double dt) {
  const Eigen::Vector3d change = kPolicyAcceleration * dt;
  return command + (goal - command).cwiseMax(-change).cwiseMin(change);
}

}  // namespace nao
