#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "daemons/referee/ball_judge.h"
#include "daemons/referee/referee.h"
#include "robot_model/scene_file.h"

namespace nao::referee {

/** A kick that one team has for itself, also that from the mark: until the ball is free again, its
 * opponents keep away.
 *
 * Source: HSL rules of 2026, Laws 8 (kick-off) and 13 to 17 (free kicks): the opponents stay
 * outside of the center circle's radius around the ball, at a goal kick outside of the penalty
 * area, except on their own goal line between the posts. The ball is free when the team has moved
 * it, or when the time for the kick is over. */
class FreeKick {
 public:
  /** @param team  The team that has the kick. @param ball  Where the ball lies, m, in the field
   * frame. */
  FreeKick(KickKind kind, int team, const Eigen::Vector2d& ball)
      : kind_(kind), team_(team), ball_(ball) {}

  /** What a step has shown. */
  struct Judgement {
    /** Opponents that stay where they may not, or have touched the ball. */
    std::vector<std::string> offenders;
    /** An opponent has moved the ball: it is put back. */
    bool is_retaken = false;
    /** The ball is free. */
    bool is_over = false;
  };

  /** @param dt  Time since the last step, s. @param players  Those with a penalty are left out. */
  Judgement step(double dt, const RefereeInput& input, const std::vector<MatchPlayer>& players,
                 const SceneFile& scene);

  int team() const { return team_; }
  const Eigen::Vector2d& ball() const { return ball_; }
  KickKind kind() const { return kind_; }

 private:
  /** Whether an opponent may not be at a place, m, in the field frame. */
  bool is_too_near(const Eigen::Vector2d& place, const SceneFile& scene) const;

  KickKind kind_;
  int team_;
  Eigen::Vector2d ball_;
  /** Time since the ball was put there, s. */
  double age_ = 0;
  /** Robots that are too near, and for how long, s. */
  std::vector<std::pair<std::string, double>> near_{};
};

}  // namespace nao::referee
