#include "daemons/motion/walk/velocity_planner.h"

#include <cmath>

namespace nao::motion {

VelocityPlanner::VelocityPlanner(const RobotModel& model, const Gait& gait)
    : gait_(&gait.velocity), limits_(model.walk_limits()), path_(gait.velocity.max_path_offset) {}

Eigen::Vector3d VelocityPlanner::clip(const Eigen::Vector3d& velocity) const {
  // The envelope's limits differ between forward and backward.
  const Eigen::Vector3d limit(velocity.x() > 0 ? limits_.forward : limits_.backward,
                              limits_.sideways, limits_.turning);
  const double speed = std::lerp(1.0, gait_->slow_speed, slowness_);
  const double turning = std::lerp(1.0, gait_->slow_turning, slowness_);
  const Eigen::Vector3d max = Eigen::Vector3d(speed, speed, turning).cwiseProduct(limit);
  const double exponent =
      std::lerp(gait_->envelope_exponent, gait_->slow_envelope_exponent, slowness_);
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += std::pow(std::abs(velocity[i]) / max[i], exponent);
  }
  // The p-norm of v_i / max_i: on the envelope it is 1, and it scales linearly, so that dividing by
  // it gives the point of the envelope in the same direction.
  const double size = std::pow(sum, 1 / exponent);
  return size > 1 ? Eigen::Vector3d(velocity / size) : velocity;
}

Eigen::Vector3d VelocityPlanner::ramp(const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& to) const {
  const Eigen::Vector3d max(gait_->max_change_vx, gait_->max_change_vy, gait_->max_change_wz);
  return from + (to - from).cwiseMax(-max).cwiseMin(max);
}

void VelocityPlanner::stop() {
  velocity_.setZero();
  step_velocity_.setZero();
}

void VelocityPlanner::begin_step(const Eigen::Vector3d& commanded, const Pose2& body,
                                 bool is_ending, bool tracks_path) {
  const Eigen::Vector3d clipped = clip(commanded);
  // The last step may stop at once: its footsteps are planned for that.
  velocity_ = is_ending ? clipped : ramp(velocity_, clipped);
  // When the robot steps in place, or something else leads it (a capture step, a kick's approach),
  // there is no path to return to.
  if (velocity_.isZero(0) || !tracks_path) {
    path_.reset(body);
    step_velocity_ = velocity_;
  } else {
    step_velocity_ = velocity_ + path_.correct(body, gait_->path_gain);
  }
}

}  // namespace nao::motion
