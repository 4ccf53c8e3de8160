#pragma once

#include <Eigen/Core>
#include <optional>

#include "daemons/play/situation.h"

namespace nao::play {

/** Where a ball comes to rest, m: a rolling one at the end of its straight path or before the feet
 * that it meets; any other where it is. All is in the odometry frame.
 * @param feet  Position of the robot, m. */
Eigen::Vector2d predict_rest(const Ball& ball, const Eigen::Vector2d& feet,
                             const PlayParameters& parameters);

/** A ball that rolls towards the robot. */
struct Shot {
  /** Time until it passes the line through the feet, at right angles to the heading, s. */
  double time = 0;
  /** Where it passes, m to the left of the feet. */
  double aside = 0;
};

/** Prediction of a rolling ball with constant deceleration.
 * @param ball, velocity  In F. @return Nothing if it does not come or stops before. */
std::optional<Shot> predict_shot(const Eigen::Vector2d& ball, const Eigen::Vector2d& velocity,
                                 const PlayParameters& parameters);

}  // namespace nao::play
