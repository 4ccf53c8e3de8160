#include "daemons/play/rolling_ball.h"

#include <algorithm>
#include <cmath>

#include "common/ball_rolling.h"
#include "daemons/play/shot_aim.h"

namespace nao::play {
namespace {

using Eigen::Vector2d;

}  // namespace

Vector2d predict_rest(const Ball& ball, const Vector2d& feet, const PlayParameters& parameters) {
  const double speed = ball.velocity.norm();
  if (!ball.is_rolling || speed <= 0) return ball.position;
  const double path =
      std::min(speed * speed / (2 * kBallRollingDeceleration), parameters.shot_aim.kick_distance);
  const Vector2d way = ball.velocity / speed;
  const Vector2d to_feet = feet - ball.position;
  const double along = to_feet.dot(way);
  const bool meets_feet = along > 0 && along < path &&
                          (to_feet - along * way).norm() < parameters.rolling_ball.stopped_by_feet;
  return ball.position +
         (meets_feet ? along - parameters.rolling_ball.stopped_by_feet : path) * way;
}

std::optional<Shot> predict_shot(const Vector2d& ball, const Vector2d& velocity,
                                 const PlayParameters& parameters) {
  const double speed = velocity.norm();
  if (speed < parameters.rolling_ball.shot_speed || velocity.x() >= 0) return std::nullopt;
  const double ahead = ball.x() - parameters.rolling_ball.foot_length;
  if (ahead < 0) return std::nullopt;
  // Along its straight path: s = v t - a t^2 / 2.
  const double path = ahead * speed / -velocity.x();
  const double root = speed * speed - 2 * kBallRollingDeceleration * path;
  if (root <= 0) return std::nullopt;
  return Shot{(speed - std::sqrt(root)) / kBallRollingDeceleration,
              ball.y() + velocity.y() * path / speed};
}

}  // namespace nao::play
