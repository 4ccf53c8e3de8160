#pragma once

#include <Eigen/Core>
#include <optional>

#include "daemons/play/ball_search.h"
#include "daemons/play/situation.h"

namespace nao::play {

/** Walks to a place on the field and stays there, with the head towards the ball. */
class Positioner {
 public:
  /** @param constants  Must outlive this. */
  explicit Positioner(const PlayConstants& constants)
      : constants_(constants), parameters_(constants.parameters.positioner) {}

  /** One step.
   * @param place  Position of the feet, in the odometry frame. @param ball  m, in the odometry
   * frame. */
  Decision step(const Pose2& place, const std::optional<Eigen::Vector2d>& ball,
                const Situation& situation);

  /** Ends the search for the ball. */
  void stop_search() { search_.stop(); }

 private:
  const PlayConstants& constants_;
  const PlayParameters::Positioner& parameters_;
  BallSearch search_;
  bool is_in_place_ = false;
};

}  // namespace nao::play
