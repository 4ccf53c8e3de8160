#pragma once

#include <Eigen/Core>

#include "daemons/play/situation.h"

namespace nao::play {

/** Where the ball should go. */
struct Aim {
  /** Direction in the odometry frame, rad, and the tolerance of the feet. */
  double heading = 0;
  double tolerance = 0;
  /** m, in the odometry frame. */
  Eigen::Vector2d target = Eigen::Vector2d::Zero();
};

/** The middle of the opponents' goal, or of its wider part beside a keeper. In a match, teams of
 * two or more have a keeper also where none is seen. @param ball  m, in the odometry frame. */
Aim aim_at_goal(const Eigen::Vector2d& ball, const Situation& situation,
                const PlayConstants& constants);

/** Turns the aim past a robot that stands in front of the ball. @param ball  m, in the odometry
 * frame. */
Aim aim_past_robots(const Aim& aim, const Eigen::Vector2d& ball, const Situation& situation,
                    const PlayConstants& constants);

}  // namespace nao::play
