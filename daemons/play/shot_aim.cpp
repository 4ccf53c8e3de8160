#include "daemons/play/shot_aim.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Error of the kick's direction, rad: its own worst error (1.7 degrees) and that of the heading.
 */
constexpr double kDirectionError = 0.06;
/** Least tolerance of a kick that does not reach the goal, rad: 0.9 m sideways at its end, where
 * the next kick is aimed again. Chosen. */
constexpr double kFarTolerance = 0.2;
/** Margin, m, to a goal post: the ball's radius and some of the pose's error. */
constexpr double kPostMargin = 0.15;
/** A robot nearer than this to the middle of the goal line, m, is the keeper. The shot passes it by
 * half the width that a standing keeper covers, m. */
constexpr double kKeeperDistance = 1.3;
constexpr double kKeeperHalf = 0.25;
/** Assumed distance of an unseen keeper before the middle of the goal line, m. */
constexpr double kKeeperOut = 0.5;
/** Difference of the openings beside a keeper, rad, below which they are equally good. */
constexpr double kEqualSides = 0.1;
/** A robot nearer to the ball than this, m, and in the direction of the kick within the angle, rad,
 * would stop it. The kick goes past it by that angle. Chosen: shoulders are 0.3 m wide. */
constexpr double kBlockingDistance = 1.0;
constexpr double kBlockingAngle = 0.6;
/** Tolerance of such a kick, rad, which only has to clear the ball. */
constexpr double kPastTolerance = 0.25;

/** Robots that may keep the goal against a ball there, in the field frame. @param ball  In the
 * field frame. */
std::vector<Vector2d> find_keepers(const Vector2d& ball, const Situation& situation,
                                   const Field& measures) {
  const Vector2d goal(0.5 * measures.length, 0);
  std::vector<Vector2d> keepers;
  for (const Vector2d& robot : situation.robots) {
    const Vector2d keeper = situation.field_in_odometry.inverse() * robot;
    const Vector2d way = keeper - ball;
    const bool is_keeper =
        (keeper - goal).norm() < kKeeperDistance && way.x() > 0.3 && way.norm() > kKeeperHalf;
    if (is_keeper) keepers.push_back(keeper);
  }
  // An unseen keeper is assumed at its usual place.
  const bool has_keeper = situation.match && situation.match->team_size > 1;
  if (keepers.empty() && has_keeper && ball.x() < goal.x() - kKeeperDistance) {
    keepers.push_back(goal + kKeeperOut * (ball - goal).normalized());
  }
  return keepers;
}

}  // namespace

Aim aim_at_goal(const Vector2d& ball, const Situation& situation, const Field& measures) {
  const Pose2& field = situation.field_in_odometry;
  const Vector2d in_field = field.inverse() * ball;
  const double goal_x = 0.5 * measures.length;
  const double half = std::max(0.2, 0.5 * measures.goal_width - kPostMargin);
  // From a ball on the goal line the opening has no direction, so a point slightly before it is
  // used.
  const double depth = std::max(0.15, goal_x - in_field.x());
  double left = std::atan2(half - in_field.y(), depth);
  double right = std::atan2(-half - in_field.y(), depth);
  // Beside the keeper.
  for (const Vector2d& keeper : find_keepers(in_field, situation, measures)) {
    const Vector2d way = keeper - in_field;
    const double bearing = std::atan2(way.y(), way.x());
    const double cover = std::asin(kKeeperHalf / way.norm());
    if (bearing + cover < right || bearing - cover > left) continue;
    // Choose the wider side; if both are about equal, the one that the robot already faces.
    double more_on_left = left - (bearing + cover) - ((bearing - cover) - right);
    if (std::abs(more_on_left) < kEqualSides) {
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
  aim.tolerance =
      std::clamp(0.5 * (left - right) - kDirectionError, kLeastTolerance, kGreatestTolerance);
  const bool is_far = (Vector2d(goal_x, 0) - in_field).norm() > kKickDistance;
  if (is_far) aim.tolerance = std::max(aim.tolerance, kFarTolerance);
  aim.target = field * Vector2d(goal_x, 0);
  return aim;
}

Aim aim_past_robots(const Aim& aim, const Vector2d& ball, const Situation& situation) {
  for (const Vector2d& robot : situation.robots) {
    const Vector2d way = robot - ball;
    const double bearing = wrapped(std::atan2(way.y(), way.x()) - aim.heading);
    if (way.norm() > kBlockingDistance || std::abs(bearing) > kBlockingAngle) continue;
    // Turn to the side with more of the field, unless the robot leaves one side open.
    const double middle = (situation.field_in_odometry.inverse() * ball).y() > 0 ? -1 : 1;
    const double side = std::abs(bearing) < 0.3 * kBlockingAngle ? middle : (bearing > 0 ? -1 : 1);
    Aim past = aim;
    past.heading = wrapped(aim.heading + bearing + side * kBlockingAngle);
    past.tolerance = kPastTolerance;
    return past;
  }
  return aim;
}

}  // namespace nao::play
