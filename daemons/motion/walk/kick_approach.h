#pragma once

#include <Eigen/Core>

namespace nao::motion {

/** Steps that bring a walking robot to a ball, so that a foot can strike it in passing. */
struct KickApproach {
  /** Steps to take before the one that strikes; 0: the step that begins now strikes. */
  int num_steps = 0;
  /** m/s ahead and to the left, in each of these steps. */
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};

/** Chooses the number of steps, and their velocity, that end with the ball before the foot that
 * kicks: of all that do, the one nearest to the velocity that the robot walks at anyway.
 *
 * @param way         From where the ball lies best for a kick in the step that begins now, to where
 *                    it lies; m, in the body's frame.
 * @param kicks_next  The foot that swings in the step that begins now is the one to kick with.
 * @param wished      m/s ahead and to the left. @param step_duration  s. */
KickApproach plan_kick_approach(const Eigen::Vector2d& way, bool kicks_next,
                                const Eigen::Vector2d& wished, double step_duration);

}  // namespace nao::motion
