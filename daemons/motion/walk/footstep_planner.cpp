#include "daemons/motion/walk/footstep_planner.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

double sign_of(bool is_left) {
  return is_left ? 1.0 : -1.0;
}

}  // namespace

// Extent of the sole ahead of and behind its frame, m, by which a turned foot comes nearer to the
// other one. Left and right soles are mirror images.
FootstepPlanner::FootstepPlanner(const RobotModel& model, const Gait& gait) : gait_(&gait) {
  for (const Eigen::Vector2d& corner : model.left_sole_outline()) {
    toe_ = std::max(toe_, corner.x());
    heel_ = std::max(heel_, -corner.x());
  }
}

// A foot can close sideways by closing_room only; the rest is divided between both feet, as a wider
// stance. The same holds for turns.
Spread FootstepPlanner::spread_for(const Eigen::Vector3d& velocity) const {
  const double step_duration = gait_->timing.step_duration;
  const double sideways = std::abs(velocity.y()) * step_duration;
  const double turn = std::abs(velocity.z()) * step_duration;
  const double closing_room =
      gait_->stance.foot_separation - gait_->step_limits.min_foot_separation;
  return {std::max(0.0, sideways - closing_room) / 2,
          std::max(0.0, turn - gait_->step_limits.turn_inward_without_spread) / 2};
}

Pose2 FootstepPlanner::foot_in_body(bool is_left, const Spread& spread) const {
  // The body frame is turn_center ahead of the midpoint of the feet, which are on both sides of it.
  const double side = sign_of(is_left);
  return {{-gait_->stance.turn_center, side * (gait_->stance.foot_separation / 2 + spread.width)},
          side * spread.heading};
}

Pose2 FootstepPlanner::square_step(bool support_is_left) const {
  return foot_in_body(support_is_left, {}).inverse() * foot_in_body(!support_is_left, {});
}

std::vector<PlannedStep> FootstepPlanner::plan(bool support_is_left, const Spread& spread,
                                               const Eigen::Vector3d& velocity, double duration,
                                               int count) const {
  const Spread next_spread = spread_for(velocity);
  // Motion of the body frame in a step at constant velocity; translation first, then turn.
  const Pose2 advance{velocity.head<2>() * duration, velocity.z() * duration};
  // Body frame in the frame of the support foot, from which all steps are planned.
  Pose2 body = foot_in_body(support_is_left, spread).inverse();
  Pose2 support;
  bool is_left = !support_is_left;
  std::vector<PlannedStep> steps;
  for (int i = 0; i < count; ++i) {
    // The body moves by one step in each iteration, and the swing foot is placed beside it; where
    // the limits of a step do not allow that, the foot stays behind, and the body's path continues
    // as commanded.
    body = body * advance;
    const Pose2 desired = body * foot_in_body(is_left, next_spread);
    const Pose2 pose = support * clip_step(support.inverse() * desired, is_left);
    steps.push_back({is_left, pose});
    support = pose;
    is_left = !is_left;
  }
  return steps;
}

Pose2 FootstepPlanner::clip_step(const Pose2& step, bool swing_is_left) const {
  const Gait::StepLimits& limits = gait_->step_limits;
  const double side = sign_of(swing_is_left);
  // Positive: outward, for either foot.
  const double outward_turn =
      std::clamp(side * step.heading, -limits.max_turn_inward, limits.max_turn_outward);
  // Turning a foot moves its toe (inward turn) or its heel (outward turn) towards the other foot.
  const double corner = (outward_turn > 0 ? heel_ : toe_) * std::abs(std::sin(outward_turn));
  const double nearest = limits.min_foot_separation + corner;
  const double farthest = gait_->stance.foot_separation + limits.max_outward;
  Pose2 result;
  result.position.x() = std::clamp(step.position.x(), -limits.max_backward, limits.max_forward);
  result.position.y() = side * std::clamp(side * step.position.y(), nearest, farthest);
  result.heading = side * outward_turn;
  return result;
}

Pose2 body_between(const Pose2& left, const Pose2& right, double turn_center) {
  // The heading is interpolated on the circle: half of the wrapped difference.
  const Pose2 midpoint{0.5 * (left.position + right.position),
                       left.heading + 0.5 * wrapped(right.heading - left.heading)};
  return midpoint * Pose2{{turn_center, 0}, 0};
}

}  // namespace nao::motion
