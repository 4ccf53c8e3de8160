#pragma once

#include <Eigen/Core>

namespace nao::motion {

/** Steps that bring a walking robot to a ball, so that a foot can kick it without a stop. */
struct KickApproach {
  /** Number of steps before the one that kicks; 0: the step that begins now kicks. */
  int num_steps = 0;
  /** Velocity of each of these steps: m/s ahead and to the left. */
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};

/** Chooses number and velocity of the steps that end with the ball before the kicking foot. It
 * takes the approach with the least cost: change of the forward velocity, plus sideways velocity,
 * plus a constant for each step.
 *
 * @param offset      Vector to the ball from its best place for a kick in the step that begins now;
 * m, in the body frame.
 * @param kicks_next  The swing foot of the step that begins now is the kicking foot.
 * @param commanded   m/s ahead and to the left. @param step_duration  s. */
KickApproach plan_kick_approach(const Eigen::Vector2d& offset, bool kicks_next,
                                const Eigen::Vector2d& commanded, double step_duration);

}  // namespace nao::motion
