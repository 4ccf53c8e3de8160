#include "daemons/play/ball_in_walk.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Distance from the middle of the opponents' goal line, m. */
double distance_to_goal(const Ball& ball, const Situation& situation, const Field& field) {
  const Vector2d goal = situation.field_in_odometry * Vector2d(0.5 * field.length, 0);
  return (goal - ball.position).norm();
}

/** Whether another robot is near the ball. */
bool is_contested(const Ball& ball, const Situation& situation, double distance) {
  return std::any_of(situation.robots.begin(), situation.robots.end(), [&](const Vector2d& robot) {
    return (robot - ball.position).norm() < distance;
  });
}

}  // namespace

bool can_kick_in_passing(const Ball& ball, const Aim& aim, const Situation& situation,
                         const PlayConstants& constants) {
  const PlayParameters::BallInWalk& parameters = constants.parameters.ball_in_walk;
  if (situation.is_still || ball.is_rolling) return false;
  const Pose2& feet = situation.robot.feet_in_odometry;
  const Vector2d in_feet = feet.inverse() * ball.position;
  const double tolerance = std::max(parameters.passing_tolerance, aim.tolerance);
  const bool is_right = in_feet.x() > parameters.passing_near &&
                        in_feet.x() < parameters.passing_far &&
                        std::abs(in_feet.y()) < parameters.passing_aside &&
                        std::abs(wrapped(aim.heading - feet.heading)) < tolerance &&
                        situation.time - ball.seen_time < parameters.passing_age;
  const double to_goal = distance_to_goal(ball, situation, constants.field);
  if (!is_right || to_goal < parameters.passing_goal_distance) return false;
  // From here a kick while standing reaches the goal, if nobody comes first.
  return to_goal >= parameters.shot_distance ||
         is_contested(ball, situation, parameters.contested_distance);
}

bool can_carry(const Ball& ball, const Aim& aim, const Situation& situation,
               const PlayConstants& constants) {
  const PlayParameters::BallInWalk& parameters = constants.parameters.ball_in_walk;
  if (situation.is_still) return false;
  const Pose2& feet = situation.robot.feet_in_odometry;
  const double to_goal = distance_to_goal(ball, situation, constants.field);
  const Vector2d in_feet = feet.inverse() * ball.position;
  return to_goal > parameters.carry_to && to_goal < parameters.shot_distance &&
         in_feet.x() > parameters.carry_near && in_feet.x() < parameters.push_reach &&
         std::abs(in_feet.y()) < parameters.carry_aside &&
         std::abs(wrapped(aim.heading - feet.heading)) < parameters.carry_tolerance &&
         !is_contested(ball, situation, parameters.contested_distance);
}

bool may_carry_on(const Ball& ball, const Situation& situation, const PlayConstants& constants) {
  const PlayParameters::BallInWalk& parameters = constants.parameters.ball_in_walk;
  return distance_to_goal(ball, situation, constants.field) >= parameters.carry_to &&
         !is_contested(ball, situation, parameters.contested_distance);
}

}  // namespace nao::play
