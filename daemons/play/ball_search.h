#pragma once

#include <optional>

#include "daemons/play/situation.h"

namespace nao::play {

/** Searches for the ball: where it was, then all around with the head, then by turning, then by
 * walking to another place in its own half, and again. */
class BallSearch {
 public:
  /** Restarts. @param last  Where the ball was last known, m, in the odometry frame. */
  void start(const std::optional<Eigen::Vector2d>& last, const Situation& situation);

  bool is_active() const { return is_active_; }
  void stop() { is_active_ = false; }

  /** Time since the start, s. */
  double duration(const Situation& situation) const { return situation.time - start_; }

  /** One step; start() must have been called. */
  Decision step(const Situation& situation, const PlayConstants& constants);

 private:
  enum class Stage { kScan, kTurn, kRoam };

  void enter(Stage stage, const Situation& situation);
  void scan(const Situation& situation, const PlayParameters::BallSearch& parameters,
            Decision& decision);
  void turn(const Situation& situation, const PlayConstants& constants, Decision& decision);
  void roam(const Situation& situation, const PlayConstants& constants, Decision& decision);

  bool is_active_ = false;
  Stage stage_ = Stage::kScan;
  double start_ = 0;
  double stage_start_ = 0;
  std::optional<Eigen::Vector2d> last_;
  /** 1: to the left. */
  double direction_ = 1;
  /** Angle turned so far, rad, and the heading in the last step. */
  double turned_ = 0;
  double heading_ = 0;
  int num_roams_ = 0;
};

}  // namespace nao::play
