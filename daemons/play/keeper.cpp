#include "daemons/play/keeper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "daemons/play/rolling_ball.h"

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Time without a sighting after which the keeper searches for the ball, s. */
constexpr double kLookForBall = 4;
/** Distance of the feet before the middle of the goal line, m: out far enough to cover more of the
 * goal's mouth, near enough that a dive comes in time. */
constexpr double kOut = 0.5;
/** Half of the width that a block covers, and the greatest that a dive reaches, m. */
constexpr double kBlockHalf = 0.2;
constexpr double kDiveReach = 0.85;
/** Time before the ball arrives at which the robot moves, s: a dive is on the ground after 0.66 s,
 * a block after 0.21 s (nao-trial block), and images and bus delay the decision. */
constexpr double kDiveTime = 1.0;
constexpr double kBlockTime = 0.6;
/** Distance from a post, m, beyond which a ball that passes the goal is ignored. */
constexpr double kWideOfPost = 0.15;
/** Greatest speed of a sidestep, m/s. */
constexpr double kAsideSpeed = 0.14;
/** Least time between two actions, s, since the second one would react to the same shot. */
constexpr double kActionPause = 1;

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
  Vector2d place = goal + kOut * way;
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
  return std::abs(y) < 0.5 * constants_.field.goal_width + kWideOfPost;
}

std::optional<Decision> Keeper::answer_shot(const Ball& ball, const Situation& situation) {
  if (!ball.is_rolling || situation.time - last_action_ < kActionPause) return std::nullopt;
  const Pose2 in_feet = situation.robot.feet_in_odometry.inverse();
  const auto shot = predict_shot(in_feet * ball.position, in_feet.rotate(ball.velocity));
  if (!shot || !is_towards_goal(ball, situation)) return std::nullopt;
  Decision decision;
  decision.gaze.point = ball.position;
  decision.phase = PlayPhase::kBlock;
  const double aside = std::abs(shot->aside);
  const ActionNames& names = constants_.actions;
  const bool needs_dive = aside > kBlockHalf;
  const std::string& action = !needs_dive       ? names.block
                              : shot->aside > 0 ? names.dive_left
                                                : names.dive_right;
  const bool is_due = shot->time < (needs_dive ? kDiveTime : kBlockTime);
  if (is_due && aside < kDiveReach && !action.empty()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    decision.action = ActionCommand{action, nan, nan, nan};
    last_action_ = situation.time;
    return decision;
  }
  // There is time for a sidestep.
  if (aside > 0.5 * kBlockHalf && shot->time > kDiveTime) {
    const double most = std::min(kAsideSpeed, constants_.walk_limits.sideways);
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
  if (ball && situation.time - ball->seen_time > kLookForBall) ball.reset();
  if (!ball) return guard(ball, situation);
  if (auto decision = answer_shot(*ball, situation)) return *decision;
  return guard(ball, situation);
}

}  // namespace nao::play
