#include "daemons/play/ball_in_walk.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Nearer to the goal than the first distance, m, no ball is kicked during the walk. Between it and
 * the second, a ball is dribbled and then shot from a stand, unless another robot is nearer to it
 * than kContestedDistance, m. Chosen with nao-trial match-error-model, seeds 101 to 112. */
constexpr double kPassingGoalDistance = 2.6;
constexpr double kShotDistance = 3.5;
constexpr double kContestedDistance = 1.2;
/** Conditions of a kick during the walk: where the ball must lie, m ahead and sideways; the
 * greatest heading error, rad; and the greatest age of the ball's position, s. */
constexpr double kPassingNear = 0.28;
constexpr double kPassingFar = 0.5;
constexpr double kPassingAside = 0.12;
constexpr double kPassingTolerance = 0.2;
constexpr double kPassingAge = 0.3;
/** Distance from the goal, m, to which a ball is dribbled before the shot: from 2.2 m and more a
 * keeper's dive stops nearly every shot, and nearer than 1.7 m the keeper comes out and clears the
 * ball. Then, where the ball must lie for dribbling, m ahead and sideways, and the greatest heading
 * error, rad. Chosen on seeds 101 to 106. */
constexpr double kCarryTo = 1.9;
constexpr double kCarryNear = 0.1;
constexpr double kCarryAside = 0.09;
constexpr double kCarryTolerance = 0.3;

/** Distance from the middle of the opponents' goal line, m. */
double distance_to_goal(const Ball& ball, const Situation& situation, const Field& field) {
  const Vector2d goal = situation.field_in_odometry * Vector2d(0.5 * field.length, 0);
  return (goal - ball.position).norm();
}

/** Whether another robot is near the ball. */
bool is_contested(const Ball& ball, const Situation& situation) {
  return std::any_of(situation.robots.begin(), situation.robots.end(), [&](const Vector2d& robot) {
    return (robot - ball.position).norm() < kContestedDistance;
  });
}

}  // namespace

bool can_kick_in_passing(const Ball& ball, const Aim& aim, const Situation& situation,
                         const Field& field) {
  if (situation.is_still || ball.is_rolling) return false;
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Vector2d in_feet = feet.inverse() * ball.position;
  const double tolerance = std::max(kPassingTolerance, aim.tolerance);
  const bool is_right = in_feet.x() > kPassingNear && in_feet.x() < kPassingFar &&
                        std::abs(in_feet.y()) < kPassingAside &&
                        std::abs(wrapped(aim.heading - feet.heading)) < tolerance &&
                        situation.time - ball.seen_time < kPassingAge;
  const double to_goal = distance_to_goal(ball, situation, field);
  if (!is_right || to_goal < kPassingGoalDistance) return false;
  // From here a kick while standing reaches the goal, if nobody comes first.
  return to_goal >= kShotDistance || is_contested(ball, situation);
}

bool can_carry(const Ball& ball, const Aim& aim, const Situation& situation, const Field& field) {
  if (situation.is_still) return false;
  const Pose2& feet = situation.robot.feet_in_odometry;
  const double to_goal = distance_to_goal(ball, situation, field);
  const Vector2d in_feet = feet.inverse() * ball.position;
  return to_goal > kCarryTo && to_goal < kShotDistance && in_feet.x() > kCarryNear &&
         in_feet.x() < kPushReach && std::abs(in_feet.y()) < kCarryAside &&
         std::abs(wrapped(aim.heading - feet.heading)) < kCarryTolerance &&
         !is_contested(ball, situation);
}

bool may_carry_on(const Ball& ball, const Situation& situation, const Field& field) {
  return distance_to_goal(ball, situation, field) >= kCarryTo && !is_contested(ball, situation);
}

}  // namespace nao::play
