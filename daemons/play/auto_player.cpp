#include "daemons/play/auto_player.h"

#include <algorithm>
#include <cmath>

#include "daemons/play/approach.h"
#include "kinematics/formation.h"

namespace nao::play {
namespace {

using Eigen::Vector2d;

}  // namespace

AutoPlayer::AutoPlayer(const PlayConstants& constants)
    : constants_(constants),
      parameters_(constants.parameters.auto_player),
      positioner_(constants),
      keeper_(constants) {}

void AutoPlayer::restart() {
  keeper_.restart();
  is_clearing_ = false;
  positioner_.stop_search();
  if (striker_) striker_->restart();
}

bool AutoPlayer::sees_ball(const Situation& situation) const {
  return situation.ball && situation.time - situation.ball->seen_time < parameters_.forget_ball &&
         situation.ball->seen_time > restart_time_;
}

void AutoPlayer::note_ball_out(const Situation& situation) {
  const bool is_played = situation.match->phase == MatchPhase::kPlaying;
  if (!is_played || !situation.match->ball_out) {
    restart_.reset();
    return;
  }
  const double time = situation.time - situation.match->ball_out->age + parameters_.ball_return;
  if (std::abs(time - restart_time_) < 0.5 * parameters_.ball_return) return;
  std::optional<Vector2d> last;
  if (situation.ball) last = situation.field_in_odometry.inverse() * situation.ball->position;
  const bool is_old =
      !situation.ball || situation.time - situation.ball->seen_time > parameters_.forget_ball;
  if (is_old) {
    if (const auto told = find_team_ball(*situation.match, {}, situation.time)) last = told;
  }
  restart_.reset();
  restart_time_ = time;
  if (!last) return;
  const Vector2d half(0.5 * constants_.field.length, 0.5 * constants_.field.width);
  restart_ =
      restart_place(*last, situation.match->ball_out->is_own, half, constants_.field.goal_area);
}

std::optional<Vector2d> AutoPlayer::find_ball(const Situation& situation) const {
  std::optional<Vector2d> own;
  if (sees_ball(situation)) {
    own = situation.field_in_odometry.inverse() * situation.ball->position;
  }
  const auto known = find_team_ball(*situation.match, own, situation.time);
  return known ? known : restart_;
}

Decision AutoPlayer::step(const Situation& situation) {
  if (situation.match) note_ball_out(situation);
  // A kick or a dive continues to its end.
  if (situation.is_performing || situation.ended) return play(situation);
  if (!situation.match) return stand(situation, Reason("match-not-played"));
  if (situation.match->penalty != Penalty::kNone) {
    striker_.reset();
    return stand(situation,
                 Reason("match-penalty", {std::string(to_string(situation.match->penalty))}));
  }
  switch (situation.match->phase) {
    case MatchPhase::kReady:
      striker_.reset();
      return take_place(situation);
    case MatchPhase::kPlaying:
      return play(situation);
    default:
      striker_.reset();
      return stand(situation, {});
  }
}

Decision AutoPlayer::stand(const Situation& situation, const Reason& reason) {
  Decision decision;
  decision.phase = PlayPhase::kGuard;
  decision.reason = reason;
  const bool is_kick_off = situation.match && situation.match->phase == MatchPhase::kSet;
  if (is_kick_off) {
    // The referee puts the ball there.
    decision.gaze.point = situation.field_in_odometry.position;
  } else if (sees_ball(situation)) {
    decision.gaze.point = situation.ball->position;
  } else {
    // Straight ahead, where the field is.
    decision.gaze.depression = 0.3;
  }
  return decision;
}

Decision AutoPlayer::take_place(const Situation& situation) {
  const MatchView& match = *situation.match;
  const Vector2d half(0.5 * constants_.field.length, 0.5 * constants_.field.width);
  const Pose2 place = situation.field_in_odometry *
                      kick_off_place(match.number, match.team_size, match.kicks_off, half);
  std::optional<Vector2d> ball;
  if (const auto seen = find_ball(situation)) ball = situation.field_in_odometry * *seen;
  return positioner_.step(place, ball, situation);
}

bool AutoPlayer::must_wait_for_kick_off(const Situation& situation,
                                        const std::optional<Vector2d>& ball) const {
  const MatchView& match = *situation.match;
  if (match.kicks_off || match.since_kick_off < 0 ||
      match.since_kick_off > parameters_.kick_off_wait) {
    return false;
  }
  return !ball || ball->norm() < parameters_.ball_moved;
}

std::optional<Vector2d> AutoPlayer::place_off_free_kick(const Vector2d& ball,
                                                        const Vector2d& position) const {
  const Field& field = constants_.field;
  const double radius = field.circle_radius + parameters_.free_kick_room;
  Vector2d away = position - ball;
  const double distance = away.norm();
  const Vector2d half(0.5 * field.length, 0.5 * field.width);
  // A goal kick, taken from the corner of the goal area: its area is the penalty area.
  const double border = half.x() - field.penalty_area_length - parameters_.free_kick_room;
  const bool is_goal_kick = ball.x() > half.x() - field.goal_area.x() - parameters_.ball_moved &&
                            std::abs(ball.y()) < 0.5 * field.goal_area.y() + parameters_.ball_moved;
  if (is_goal_kick && position.x() > border) return Vector2d(border - 0.1, position.y());
  if (distance > radius) return std::nullopt;
  // Towards the own goal, if the robot stands on the ball.
  if (distance < 0.1) away = Vector2d(-half.x(), 0) - ball;
  Vector2d place = ball + (radius + 0.1) * away.normalized();
  if (place.cwiseAbs().y() > half.y()) place = ball - (radius + 0.1) * Vector2d(1, 0);
  return place;
}

Decision AutoPlayer::play(const Situation& situation) {
  if (!situation.match) {
    return role_ == PlayRole::kKeeper ? keeper_.step(situation) : strike(situation);
  }
  const std::optional<Vector2d> ball = find_ball(situation);
  const Vector2d position =
      situation.field_in_odometry.inverse() * situation.robot.feet_in_odometry.position;
  const bool is_busy = situation.is_performing || situation.ended.has_value();
  if (!is_busy) role_ = choose_role(*situation.match, position, ball, role_);
  Decision decision;
  if (!is_busy) {
    is_clearing_ = role_ == PlayRole::kKeeper && is_to_be_cleared(situation, ball, position);
  }
  if (role_ == PlayRole::kKeeper && !is_clearing_) {
    decision = keeper_.step(situation);
  } else if (!is_busy && must_wait_for_kick_off(situation, ball)) {
    decision = stand(situation, {});
  } else if (!is_busy && ball && situation.match->ball_out && !situation.match->ball_out->is_own &&
             situation.time > restart_time_) {
    decision = keep_away(situation, *ball, position);
  } else if (role_ == PlayRole::kSupporter && ball) {
    decision = support(situation, *ball);
  } else if (!is_busy && ball && !sees_ball(situation) &&
             (*ball - position).norm() > parameters_.told_distance) {
    decision = go_where_told(situation, *ball);
  } else {
    decision = strike(situation);
  }
  if (role_ != PlayRole::kStriker && !is_clearing_) striker_.reset();
  decision.role = role_;
  return decision;
}

bool AutoPlayer::is_to_be_cleared(const Situation& situation, const std::optional<Vector2d>& ball,
                                  const Vector2d& position) const {
  if (!ball || !situation.ball || situation.ball->is_rolling) return false;
  const double limit = is_clearing_ ? parameters_.cleared_distance : parameters_.clear_distance;
  return (*ball - position).norm() < limit &&
         ball->x() < -0.5 * constants_.field.length + parameters_.clear_zone;
}

Decision AutoPlayer::strike(const Situation& situation) {
  if (!striker_) {
    striker_ = std::make_unique<Striker>(constants_, Striker::Task::kScore, std::nullopt, true);
  }
  Decision decision = striker_->step(situation);
  // A match continues after a goal, and while nobody has found the ball.
  if (decision.is_done) {
    striker_.reset();
    decision.is_done = false;
    decision.has_failed = false;
    decision.phase = PlayPhase::kSearch;
  }
  return decision;
}

Decision AutoPlayer::go_where_told(const Situation& situation, const Vector2d& ball) {
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Vector2d place = situation.field_in_odometry * ball;
  const Vector2d way = place - feet.position;
  Decision decision;
  decision.phase = PlayPhase::kApproach;
  decision.reason = Reason("ball-not-in-sight");
  decision.target = place;
  decision.gaze.point = place;
  decision.walk = plan_walk_to({place, std::atan2(way.y(), way.x())}, feet, constants_);
  return decision;
}

Decision AutoPlayer::keep_away(const Situation& situation, const Vector2d& ball,
                               const Vector2d& position) {
  striker_.reset();
  const auto place = place_off_free_kick(ball, position);
  if (!place) return stand(situation, {});
  const Vector2d way = ball - *place;
  return positioner_.step(situation.field_in_odometry * Pose2{*place, std::atan2(way.y(), way.x())},
                          situation.field_in_odometry * ball, situation);
}

Decision AutoPlayer::support(const Situation& situation, const Vector2d& ball) {
  const Vector2d half(0.5 * constants_.field.length, 0.5 * constants_.field.width);
  Vector2d place(ball.x() - parameters_.behind_ball,
                 ball.y() + (ball.y() > 0 ? -1 : 1) * parameters_.beside_ball);
  place.x() = std::max(place.x(), -half.x() + constants_.field.goal_depth + 1);
  place.y() = std::clamp(place.y(), -half.y() + parameters_.from_side_line,
                         half.y() - parameters_.from_side_line);
  const Vector2d way = ball - place;
  const Pose2 in_field{place, std::atan2(way.y(), way.x())};
  return positioner_.step(situation.field_in_odometry * in_field,
                          situation.field_in_odometry * ball, situation);
}

}  // namespace nao::play
