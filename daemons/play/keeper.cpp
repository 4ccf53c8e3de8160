#include "daemons/play/keeper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "daemons/play/rolling_ball.h"

namespace nao::play {
namespace {

using Eigen::Vector2d;

}  // namespace

Pose2 Keeper::calc_place(const std::optional<Vector2d>& ball, const Situation& situation) const {
  const Pose2& field = situation.field_in_odometry;
  const Vector2d goal(-0.5 * constants_.field.length, 0);
  Vector2d way(1, 0);
  if (ball) {
    const Vector2d seen = field.inverse() * *ball - goal;
    // Never behind the goal line.
    if (seen.norm() > 0.1) way = Vector2d(std::max(seen.x(), 0.1), seen.y()).normalized();
  }
  Vector2d place = goal + parameters_.out * way;
  place.x() = std::max(place.x(), goal.x() + 0.2);
  return {field * place, wrapped(field.heading + std::atan2(way.y(), way.x()))};
}

bool Keeper::is_towards_goal(const Ball& ball, const Situation& situation) const {
  const Pose2 in_field = situation.field_in_odometry.inverse();
  const Vector2d position = in_field * ball.position;
  const Vector2d velocity = in_field.rotate(ball.velocity);
  if (velocity.x() >= 0) return false;
  const double way = position.x() + 0.5 * constants_.field.length;
  if (way < 0) return false;
  const double y = position.y() + velocity.y() * way / -velocity.x();
  return std::abs(y) < 0.5 * constants_.field.goal_width + parameters_.wide_of_post;
}

std::optional<Decision> Keeper::answer_shot(const Ball& ball, const Situation& situation) {
  if (!ball.is_rolling || situation.time - last_action_ < parameters_.action_pause)
    return std::nullopt;
  const Pose2 in_feet = situation.robot.feet_in_odometry.inverse();
  const auto shot =
      predict_shot(in_feet * ball.position, in_feet.rotate(ball.velocity), constants_.parameters);
  if (!shot || !is_towards_goal(ball, situation)) return std::nullopt;
  Decision decision;
  decision.gaze.point = ball.position;
  decision.phase = PlayPhase::kBlock;
  const double aside = std::abs(shot->aside);
  const ActionNames& names = constants_.actions;
  const bool needs_dive = aside > parameters_.block_half;
  const std::string& action = !needs_dive       ? names.block
                              : shot->aside > 0 ? names.dive_left
                                                : names.dive_right;
  const bool is_due = shot->time < (needs_dive ? parameters_.dive_time : parameters_.block_time);
  if (is_due && aside < parameters_.dive_reach && !action.empty()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    decision.action = ActionCommand{action, nan, nan, nan};
    last_action_ = situation.time;
    return decision;
  }
  // There is time for a sidestep.
  if (aside > 0.5 * parameters_.block_half && shot->time > parameters_.dive_time) {
    const double most = std::min(parameters_.aside_speed, constants_.walk_limits.sideways);
    decision.walk.vy = std::clamp(shot->aside, -most, most);
  }
  return decision;
}

Decision Keeper::guard(const std::optional<Ball>& ball, const Situation& situation) {
  const std::optional<Vector2d> position =
      ball ? std::optional<Vector2d>(ball->position) : std::nullopt;
  return positioner_.step(calc_place(position, situation), position, situation);
}

Decision Keeper::step(const Situation& situation) {
  if (situation.is_performing) {
    Decision decision;
    decision.phase = PlayPhase::kBlock;
    return decision;
  }
  std::optional<Ball> ball = situation.ball;
  if (ball && situation.time - ball->seen_time > parameters_.look_for_ball) ball.reset();
  if (!ball) return guard(ball, situation);
  if (auto decision = answer_shot(*ball, situation)) return *decision;
  return guard(ball, situation);
}

}  // namespace nao::play
