#include "daemons/play/shot_aim.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Robots that may keep the goal against a ball there, in the field frame. @param ball  In the
 * field frame. */
std::vector<Vector2d> find_keepers(const Vector2d& ball, const Situation& situation,
                                   const PlayConstants& constants) {
  const PlayParameters::ShotAim& parameters = constants.parameters.shot_aim;
  const Field& measures = constants.field;
  const Vector2d goal(0.5 * measures.length, 0);
  std::vector<Vector2d> keepers;
  for (const Vector2d& robot : situation.robots) {
    const Vector2d keeper = situation.field_in_odometry.inverse() * robot;
    const Vector2d way = keeper - ball;
    const bool is_keeper = (keeper - goal).norm() < parameters.keeper_distance && way.x() > 0.3 &&
                           way.norm() > parameters.keeper_half;
    if (is_keeper) keepers.push_back(keeper);
  }
  // An unseen keeper is assumed at its usual place.
  const bool has_keeper = situation.match && situation.match->team_size > 1;
  if (keepers.empty() && has_keeper && ball.x() < goal.x() - parameters.keeper_distance) {
    keepers.push_back(goal + parameters.keeper_out * (ball - goal).normalized());
  }
  return keepers;
}

}  // namespace

Aim aim_at_goal(const Vector2d& ball, const Situation& situation, const PlayConstants& constants) {
  const PlayParameters::ShotAim& parameters = constants.parameters.shot_aim;
  const Field& measures = constants.field;
  const Pose2& field = situation.field_in_odometry;
  const Vector2d in_field = field.inverse() * ball;
  const double goal_x = 0.5 * measures.length;
  const double half = std::max(0.2, 0.5 * measures.goal_width - parameters.post_margin);
  // From a ball on the goal line the opening has no direction, so a point slightly before it is
  // used.
  const double depth = std::max(0.15, goal_x - in_field.x());
  double left = std::atan2(half - in_field.y(), depth);
  double right = std::atan2(-half - in_field.y(), depth);
  // Beside the keeper.
  for (const Vector2d& keeper : find_keepers(in_field, situation, constants)) {
    const Vector2d way = keeper - in_field;
    const double bearing = std::atan2(way.y(), way.x());
    const double cover = std::asin(parameters.keeper_half / way.norm());
    if (bearing + cover < right || bearing - cover > left) continue;
    // Choose the wider side; if both are about equal, the one that the robot already faces.
    double more_on_left = left - (bearing + cover) - ((bearing - cover) - right);
    if (std::abs(more_on_left) < parameters.equal_sides) {
      const Vector2d facing =
          in_field - field.inverse() * situation.robot.feet_in_odometry.position;
      more_on_left = std::atan2(facing.y(), facing.x()) - bearing;
    }
    if (more_on_left > 0) {
      right = std::min(bearing + cover, left - 0.02);
    } else {
      left = std::max(bearing - cover, right + 0.02);
    }
  }
  Aim aim;
  aim.heading = wrapped(field.heading + 0.5 * (left + right));
  aim.tolerance = std::clamp(0.5 * (left - right) - parameters.direction_error,
                             parameters.least_tolerance, parameters.greatest_tolerance);
  const bool is_far = (Vector2d(goal_x, 0) - in_field).norm() > parameters.kick_distance;
  if (is_far) aim.tolerance = std::max(aim.tolerance, parameters.far_tolerance);
  aim.target = field * Vector2d(goal_x, 0);
  return aim;
}

Aim aim_past_robots(const Aim& aim, const Vector2d& ball, const Situation& situation,
                    const PlayConstants& constants) {
  const PlayParameters::ShotAim& parameters = constants.parameters.shot_aim;
  for (const Vector2d& robot : situation.robots) {
    const Vector2d way = robot - ball;
    const double bearing = wrapped(std::atan2(way.y(), way.x()) - aim.heading);
    if (way.norm() > parameters.blocking_distance || std::abs(bearing) > parameters.blocking_angle)
      continue;
    // Turn to the side with more of the field, unless the robot leaves one side open.
    const double middle = (situation.field_in_odometry.inverse() * ball).y() > 0 ? -1 : 1;
    const double side =
        std::abs(bearing) < 0.3 * parameters.blocking_angle ? middle : (bearing > 0 ? -1 : 1);
    Aim past = aim;
    past.heading = wrapped(aim.heading + bearing + side * parameters.blocking_angle);
    past.tolerance = parameters.past_tolerance;
    return past;
  }
  return aim;
}

}  // namespace nao::play
