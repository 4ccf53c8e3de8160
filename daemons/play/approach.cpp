#include "daemons/play/approach.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Radius, m, of the circle about the ball that the feet's middle does not enter before they are
 * behind it: half a foot's length and the ball's radius, and 0.12 m for steps that are longer than
 * planned. */
constexpr double kCircle = 0.3;
/** Least angle, rad, by which the next point of the path around the ball leads. */
constexpr double kLeastLead = 0.6;
/** Polar angle to the goal's below which the feet are behind the ball, rad. Chosen: from there the
 * straight path to the goal does not touch the ball. */
constexpr double kBehind = 0.45;
/** Distance from the next point, m, beyond which the robot looks where it walks. */
constexpr double kFar = 0.8;
/** Gains from errors to velocities, 1/s. Chosen: the gait's own path gain and a larger one; with
 * the walk's lag of about 0.4 s (two steps) both are stable. */
constexpr double kPositionGain = 1.2;
constexpr double kHeadingGain = 1.4;
/** Greatest velocities near the ball, m/s: ahead and sideways. */
constexpr double kNearForward = 0.14;
constexpr double kNearSideways = 0.1;
/** Fractions of the gait's limits that are commanded: the rest is for its feedback. */
constexpr double kLimitFraction = 0.95;
constexpr double kTurnFraction = 0.5;

/** Polar angle of a point about a center, rad. */
double angle_of(const Vector2d& point, const Vector2d& center) {
  return std::atan2(point.y() - center.y(), point.x() - center.x());
}

Vector2d on_circle(const Vector2d& center, double radius, double angle) {
  return center + radius * Vector2d(std::cos(angle), std::sin(angle));
}

/** Velocity to a point at a heading. @param fastest  Speed limits, m/s ahead and sideways. */
WalkCommand head_for(const Vector2d& point, double heading, const Pose2& feet,
                     const Vector2d& fastest, const WalkLimits& limits) {
  const Vector2d error = Eigen::Rotation2Dd(-feet.heading) * (point - feet.position);
  const double turn = wrapped(heading - feet.heading);
  WalkCommand walk;
  Vector2d velocity = kPositionGain * error;
  // The direction is kept where a limit shortens the velocity.
  const double backward = std::min(fastest.x(), limits.backward * kLimitFraction);
  const double ahead = velocity.x() >= 0 ? fastest.x() : backward;
  const double scale = std::max({1.0, std::abs(velocity.x()) / std::max(ahead, 1e-6),
                                 std::abs(velocity.y()) / std::max(fastest.y(), 1e-6)});
  velocity /= scale;
  // A robot that looks elsewhere turns first.
  const double share = std::clamp(1.3 - std::abs(turn), 0.15, 1.0);
  walk.vx = share * velocity.x();
  walk.vy = share * velocity.y();
  const double most = kTurnFraction * limits.turning;
  walk.wz = std::clamp(kHeadingGain * turn, -most, most);
  return walk;
}

}  // namespace

Pose2 ApproachGoal::feet() const {
  return {ball - Eigen::Rotation2Dd(heading) * ball_in_feet, heading};
}

Pose2 calc_approach_error(const ApproachGoal& goal, const Pose2& feet) {
  Pose2 error = goal.feet().inverse() * feet;
  error.heading = wrapped(error.heading);
  return error;
}

WalkCommand plan_approach(const ApproachGoal& goal, const Pose2& feet, const WalkLimits& limits) {
  const Pose2 aim = goal.feet();
  const double distance = (feet.position - goal.ball).norm();
  const double angle = angle_of(feet.position, goal.ball);
  // Seen from the ball, the goal lies opposite to its heading.
  const double to_go = wrapped(goal.heading + M_PI - angle);
  const Vector2d far_speed(kLimitFraction * limits.forward, 0.5 * limits.sideways);
  const Vector2d near_speed(std::min(kNearForward, limits.forward),
                            std::min(kNearSideways, limits.sideways));
  const bool is_behind = std::abs(to_go) < kBehind;
  const double heading_error = std::abs(wrapped(goal.heading - feet.heading));
  if (is_behind && distance < kCircle + 0.25) {
    // In the last steps, the robot turns first if its feet could touch the ball.
    if (heading_error > 0.4 && distance < kCircle) {
      const Vector2d back = on_circle(goal.ball, kCircle, angle);
      return head_for(back, goal.heading, feet, near_speed, limits);
    }
    return head_for(aim.position, goal.heading, feet, near_speed, limits);
  }
  // Angle about the ball of the tangent point of the circle, seen from the feet.
  const double tangent = distance > kCircle ? std::acos(kCircle / distance) : 0;
  const double step = std::max(tangent, kLeastLead);
  const double angle_to =
      std::abs(to_go) <= step ? goal.heading + M_PI : angle + std::copysign(step, to_go);
  // At its end, the path around the ball meets the goal's line where the straight path begins.
  const Vector2d next = on_circle(goal.ball, kCircle + 0.05, angle_to);
  if ((next - feet.position).norm() > kFar) {
    return head_for(next, angle_of(next, feet.position), feet, far_speed, limits);
  }
  const double heading = std::abs(to_go) > 0.7 ? angle_of(goal.ball, feet.position) : goal.heading;
  const Vector2d speed(0.7 * far_speed.x(), 0.75 * limits.sideways);
  return head_for(next, heading, feet, speed, limits);
}

WalkCommand plan_walk_to(const Pose2& pose, const Pose2& feet, const WalkLimits& limits) {
  const bool is_far = (pose.position - feet.position).norm() > kFar;
  const double heading = is_far ? angle_of(pose.position, feet.position) : pose.heading;
  return head_for(pose.position, heading, feet,
                  {kLimitFraction * limits.forward, 0.75 * limits.sideways}, limits);
}

}  // namespace nao::play
