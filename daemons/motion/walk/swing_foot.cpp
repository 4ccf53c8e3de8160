#include "daemons/motion/walk/swing_foot.h"

#include <algorithm>

namespace nao::motion {

void SwingFoot::start(const Pose2& start, double height) {
  pose_ = start;
  velocity_.setZero();
  start_height_ = height;
  height_ = height;
}

void SwingFoot::step(const Pose2& foothold, double remaining, double phase, double lift,
                     double dt) {
  const Eigen::Vector3d at(pose_.position.x(), pose_.position.y(), pose_.heading);
  const Eigen::Vector3d to(foothold.position.x(), foothold.position.y(), foothold.heading);
  Eigen::Vector3d next = to;
  if (remaining > 1.5 * dt) {
    // The cubic with x(0) = at, x'(0) = v, x(t) = to, x'(t) = 0 has
    //   x''(0) = 6 (to - at) / t^2 - 4 v / t  and  x''' = -12 (to - at) / t^3 + 6 v / t^2.
    const double t = remaining;
    const Eigen::Vector3d acceleration = 6 / (t * t) * (to - at) - 4 / t * velocity_;
    const Eigen::Vector3d jerk = -12 / (t * t * t) * (to - at) + 6 / (t * t) * velocity_;
    next = at + dt * velocity_ + dt * dt / 2 * acceleration + dt * dt * dt / 6 * jerk;
    velocity_ += dt * acceleration + dt * dt / 2 * jerk;
  } else {
    // The last tick, or a foothold that changed after arrival.
    velocity_ = (to - at) / dt;
  }
  pose_ = {next.head<2>(), next.z()};
  // 16 s^2 (1 - s)^2 is 1 at s = 1/2 and has zero slope at both ends; a start height that is not 0
  // is removed linearly.
  const double s = std::clamp(phase, 0.0, 1.0);
  height_ = (1 - s) * start_height_ + lift * 16 * s * s * (1 - s) * (1 - s);
}

}  // namespace nao::motion
