#include "daemons/play/approach.h"

#include <algorithm>
#include <cmath>

namespace nao::play {
namespace {

using Eigen::Vector2d;

/** Polar angle of a point about a center, rad. */
double angle_of(const Vector2d& point, const Vector2d& center) {
  return std::atan2(point.y() - center.y(), point.x() - center.x());
}

Vector2d on_circle(const Vector2d& center, double radius, double angle) {
  return center + radius * Vector2d(std::cos(angle), std::sin(angle));
}

/** Velocity to a point at a heading. @param fastest  Speed limits, m/s ahead and sideways. */
WalkCommand head_for(const Vector2d& point, double heading, const Pose2& feet,
                     const Vector2d& fastest, const PlayConstants& constants) {
  const WalkLimits& limits = constants.walk_limits;
  const PlayParameters::Approach& parameters = constants.parameters.approach;
  const Vector2d error = Eigen::Rotation2Dd(-feet.heading) * (point - feet.position);
  const double turn = wrapped(heading - feet.heading);
  WalkCommand walk;
  Vector2d velocity = parameters.position_gain * error;
  // The direction is kept where a limit shortens the velocity.
  const double backward = std::min(fastest.x(), limits.backward * parameters.limit_fraction);
  const double ahead = velocity.x() >= 0 ? fastest.x() : backward;
  const double scale = std::max({1.0, std::abs(velocity.x()) / std::max(ahead, 1e-6),
                                 std::abs(velocity.y()) / std::max(fastest.y(), 1e-6)});
  velocity /= scale;
  // A robot that looks elsewhere turns first.
  const double share = std::clamp(1.3 - std::abs(turn), 0.15, 1.0);
  walk.vx = share * velocity.x();
  walk.vy = share * velocity.y();
  const double most = parameters.turn_fraction * limits.turning;
  walk.wz = std::clamp(parameters.heading_gain * turn, -most, most);
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

WalkCommand plan_approach(const ApproachGoal& goal, const Pose2& feet,
                          const PlayConstants& constants) {
  const WalkLimits& limits = constants.walk_limits;
  const PlayParameters::Approach& parameters = constants.parameters.approach;
  const Pose2 aim = goal.feet();
  const double distance = (feet.position - goal.ball).norm();
  const double angle = angle_of(feet.position, goal.ball);
  // Seen from the ball, the goal lies opposite to its heading.
  const double to_go = wrapped(goal.heading + M_PI - angle);
  const Vector2d far_speed(parameters.limit_fraction * limits.forward, 0.5 * limits.sideways);
  const Vector2d near_speed(std::min(parameters.near_forward, limits.forward),
                            std::min(parameters.near_sideways, limits.sideways));
  const bool is_behind = std::abs(to_go) < parameters.behind;
  const double heading_error = std::abs(wrapped(goal.heading - feet.heading));
  if (is_behind && distance < parameters.circle + 0.25) {
    // In the last steps, the robot turns first if its feet could touch the ball.
    if (heading_error > 0.4 && distance < parameters.circle) {
      const Vector2d back = on_circle(goal.ball, parameters.circle, angle);
      return head_for(back, goal.heading, feet, near_speed, constants);
    }
    return head_for(aim.position, goal.heading, feet, near_speed, constants);
  }
  // Angle about the ball of the tangent point of the circle, seen from the feet.
  const double tangent = distance > parameters.circle ? std::acos(parameters.circle / distance) : 0;
  const double step = std::max(tangent, parameters.least_lead);
  const double angle_to =
      std::abs(to_go) <= step ? goal.heading + M_PI : angle + std::copysign(step, to_go);
  // At its end, the path around the ball meets the goal's line where the straight path begins.
  const Vector2d next = on_circle(goal.ball, parameters.circle + 0.05, angle_to);
  if ((next - feet.position).norm() > parameters.far) {
    return head_for(next, angle_of(next, feet.position), feet, far_speed, constants);
  }
  const double heading = std::abs(to_go) > 0.7 ? angle_of(goal.ball, feet.position) : goal.heading;
  const Vector2d speed(0.7 * far_speed.x(), 0.75 * limits.sideways);
  return head_for(next, heading, feet, speed, constants);
}

WalkCommand plan_walk_to(const Pose2& pose, const Pose2& feet, const PlayConstants& constants) {
  const WalkLimits& limits = constants.walk_limits;
  const PlayParameters::Approach& parameters = constants.parameters.approach;
  const bool is_far = (pose.position - feet.position).norm() > parameters.far;
  const double heading = is_far ? angle_of(pose.position, feet.position) : pose.heading;
  return head_for(pose.position, heading, feet,
                  {parameters.limit_fraction * limits.forward, 0.75 * limits.sideways}, constants);
}

}  // namespace nao::play
