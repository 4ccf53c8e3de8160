#pragma once

#include <Eigen/Core>

namespace nao {

/** Greatest change of the velocity that a policy is commanded, m/s^2 and rad/s^2. Chosen: other
 * people's policies are trained with jumps; less is gentler. */
inline const Eigen::Vector3d kPolicyAcceleration(1, 1, 2);

/** Velocity at which a policy steps in place, m/s: its phase may rest at 0. */
inline const Eigen::Vector3d kStepInPlace(1e-6, 0, 0);
/** For so many gait cycles a robot that was pushed steps in place (chosen); and the lead of its
 * phase, cycles, when it is pushed to the right: the foot on that side swings first. */
inline constexpr double kRecoveryCycles = 2;
inline constexpr double kRightLead = 0.5;

/** @return The commanded velocity, m/s and rad/s, after a time dt, s, on its way to a goal. */
inline Eigen::Vector3d ramp_command(const Eigen::Vector3d& command, const Eigen::Vector3d& goal,
                                    double dt) {
  const Eigen::Vector3d change = kPolicyAcceleration * dt;
  return command + (goal - command).cwiseMax(-change).cwiseMin(change);
}

}  // namespace nao
