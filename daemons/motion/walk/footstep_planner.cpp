#include "daemons/motion/walk/footstep_planner.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

double sign_of(bool is_left) {
  return is_left ? 1.0 : -1.0;
}

}  // namespace

FootstepPlanner::FootstepPlanner(const RobotModel& model, const Gait& gait)
    : gait_(&gait), limits_(model.walk_limits()) {
  for (const Eigen::Vector2d& corner : model.left_sole_outline()) {
    toe_ = std::max(toe_, corner.x());
    heel_ = std::max(heel_, -corner.x());
  }
}

Eigen::Vector3d FootstepPlanner::clip_velocity(const Eigen::Vector3d& velocity) const {
  const Eigen::Vector3d greatest(velocity.x() > 0 ? limits_.forward : limits_.backward,
                                 limits_.sideways, limits_.turning);
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += std::pow(std::abs(velocity[i]) / greatest[i], gait_->envelope_exponent);
  }
  const double size = std::pow(sum, 1 / gait_->envelope_exponent);
  return size > 1 ? Eigen::Vector3d(velocity / size) : velocity;
}

Eigen::Vector3d FootstepPlanner::ramp_velocity(const Eigen::Vector3d& from,
                                               const Eigen::Vector3d& to) const {
  const Eigen::Vector3d greatest(gait_->max_change_forward, gait_->max_change_sideways,
                                 gait_->max_change_turning);
  return from + (to - from).cwiseMax(-greatest).cwiseMin(greatest);
}

Spread FootstepPlanner::spread_for(const Eigen::Vector3d& velocity) const {
  const double sideways = std::abs(velocity.y()) * gait_->step_duration;
  const double turn = std::abs(velocity.z()) * gait_->step_duration;
  const double may_close = gait_->foot_separation - gait_->min_foot_separation;
  return {std::max(0.0, sideways - may_close) / 2, std::max(0.0, turn - gait_->turn_inward) / 2};
}

Pose2 FootstepPlanner::foot_in_body(bool is_left, const Spread& spread) const {
  const double side = sign_of(is_left);
  return {{-gait_->turn_centre, side * (gait_->foot_separation / 2 + spread.width)},
          side * spread.heading};
}

std::vector<PlannedStep> FootstepPlanner::plan(bool support_is_left, const Spread& spread,
                                               const Eigen::Vector3d& velocity, double duration,
                                               int count) const {
  const Spread next_spread = spread_for(velocity);
  const Pose2 advance{velocity.head<2>() * duration, velocity.z() * duration};
  Pose2 body = foot_in_body(support_is_left, spread).inverse();
  Pose2 support;
  bool is_left = !support_is_left;
  std::vector<PlannedStep> steps;
  for (int i = 0; i < count; ++i) {
    body = body * advance;
    const Pose2 wished = body * foot_in_body(is_left, next_spread);
    const Pose2 pose = support * clip_step(support.inverse() * wished, is_left);
    steps.push_back({is_left, pose});
    support = pose;
    is_left = !is_left;
  }
  return steps;
}

Pose2 FootstepPlanner::clip_step(const Pose2& step, bool swing_is_left) const {
  const double side = sign_of(swing_is_left);
  const double outward_turn =
      std::clamp(side * step.heading, -gait_->max_turn_inward, gait_->max_turn_outward);
  // A foot that is turned brings its toe or its heel nearer to the other one.
  const double corner = (outward_turn > 0 ? heel_ : toe_) * std::abs(std::sin(outward_turn));
  const double nearest = gait_->min_foot_separation + corner;
  const double farthest = gait_->foot_separation + gait_->max_step_outward;
  Pose2 result;
  result.position.x() =
      std::clamp(step.position.x(), -gait_->max_step_backward, gait_->max_step_forward);
  result.position.y() = side * std::clamp(side * step.position.y(), nearest, farthest);
  result.heading = side * outward_turn;
  return result;
}

}  // namespace nao::motion
