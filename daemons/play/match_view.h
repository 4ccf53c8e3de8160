#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/pose2.h"
#include "messages/match_state.h"

namespace nao::play {

/** Sightings of another robot of the same team, from its messages. */
struct TeamObservation {
  /** Robot time, s. */
  double time = 0;
  /** Its feet on the field as its team sees it: x towards the opponents' goal, m. */
  std::optional<Eigen::Vector2d> position{};
  /** The ball, if it is in its last image, m. */
  std::optional<Eigen::Vector2d> ball{};
};

/** Another player of the same team. */
struct Teammate {
  int number = 1;
  /** Plays by itself, without a penalty. */
  bool is_playing = false;
  /** Has a penalty. */
  bool is_penalised = false;
  TeamObservation seen;
};

/** A match as one of its robots sees it. */
struct MatchView {
  MatchPhase phase = MatchPhase::kInitial;
  Penalty penalty = Penalty::kNone;
  int number = 1;
  int team_size = 1;
  bool kicks_off = false;
  /** Time since the last kick-off, s; negative if there was none. */
  double since_kick_off = -1;
  /** Time since the ball left the field, s, and whether the robot's team restarts; nothing if that
   * was long ago. */
  struct BallOut {
    double age = 0;
    bool is_own = false;
  };
  std::optional<BallOut> ball_out{};
  std::vector<Teammate> teammates{};
};

/** @param seen  By other robots, by their names. @param time  Robot time, s.
 * @return Nothing if the robot does not take part. */
std::optional<MatchView> view_match(const MatchState& state, const std::string& robot, double time,
                                    const std::map<std::string, TeamObservation>& seen);

/** Position of the ball as a team knows it, m, on the field as the team sees it: from the robot
 * itself, otherwise from the teammate that saw it last. @param own  Nothing: the robot itself does
 * not know. @param time  Robot time, s. */
std::optional<Eigen::Vector2d> find_team_ball(const MatchView& match,
                                              const std::optional<Eigen::Vector2d>& own,
                                              double time);

/** The robot's task in its team. Among the players that play by themselves, the one with the
 * highest number keeps the goal if the team has another player without a penalty; the one nearest
 * to the ball among the others is the striker.
 * @param position  Position of the robot, m. @param ball  Nothing: unknown.
 * @param present  Its role until now, which it keeps if the distances differ little. */
PlayRole choose_role(const MatchView& match, const Eigen::Vector2d& position,
                     const std::optional<Eigen::Vector2d>& ball, PlayRole present);

}  // namespace nao::play
