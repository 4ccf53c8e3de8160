#pragma once

#include <Eigen/Core>

#include "daemons/play/situation.h"

namespace nao::play {

/** A pose of the feet behind a ball. */
struct ApproachGoal {
  /** m; frames of all: odometry. */
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();
  /** Heading at the goal, rad: the direction in which the ball is to go. */
  double heading = 0;
  /** Ball seen from the feet at the goal, m, ahead and to the left. */
  Eigen::Vector2d ball_in_feet = Eigen::Vector2d::Zero();

  /** The feet at the goal. */
  Pose2 feet() const;
};

/** Pose of the feet relative to the goal: ahead and left, m, in the goal's frame, and rad. */
Pose2 calc_approach_error(const ApproachGoal& goal, const Pose2& feet);

/** Velocity that leads the feet to the goal on a curve that does not touch the ball: tangentially
 * around a circle about it, then straight ahead to the goal. Far from the ball the robot looks
 * where it walks; near it, it looks at the ball and then along the goal's heading. */
WalkCommand plan_approach(const ApproachGoal& goal, const Pose2& feet,
                          const PlayConstants& constants);

/** Velocity that leads the feet straight to a pose, turning to it on the way. */
WalkCommand plan_walk_to(const Pose2& pose, const Pose2& feet, const PlayConstants& constants);

}  // namespace nao::play
