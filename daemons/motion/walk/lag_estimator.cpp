#include "daemons/motion/walk/lag_estimator.h"

#include <algorithm>

namespace nao::motion {
namespace {

// Time constant of the sums, s. Chosen: two steps, so that a change of the lag is known after a
// few.
constexpr double kTimeConstant = 0.5;
// Least sum of squared increments from which a lag is taken, rad^2. Chosen: an increment of 0.01
// rad (1 rad/s in a tick) of one joint in 20 ticks, far above the steps of an encoder (0.0015 rad).
constexpr double kLeastMotion = 2e-3;
// The best lag must explain this fraction of the motion: a robot that is held does not follow its
// commands, and its lag is kept.
constexpr double kLeastExplained = 0.5;
// Time constant with which the result follows the minimum, s. Chosen: below that of the
// sums.
constexpr double kResultTimeConstant = 0.2;

}  // namespace

void LagEstimator::start(double lag) {
  lag_ = lag;
  is_started_ = false;
  error_.fill(0);
  motion_ = 0;
}

void LagEstimator::update(const std::vector<double>& commanded, const std::vector<double>& measured,
                          const std::vector<int>& joints, double dt) {
  const size_t count = joints.size();
  if (moved_.size() != count) {
    moved_.assign(count, 0);
    last_commanded_.assign(count, 0);
    last_measured_.assign(count, 0);
    for (std::vector<double>& increments : commanded_) increments.assign(count, 0);
  }
  if (!is_started_) {
    for (std::vector<double>& increments : commanded_) {
      std::fill(increments.begin(), increments.end(), 0);
    }
  }
  // commanded_ is a ring of increments of the last kMaxTicks ticks, for each joint.
  newest_ = (newest_ + 1) % kMaxTicks;
  for (size_t i = 0; i < count; ++i) {
    const double target = commanded[joints[i]];
    const double angle = measured[joints[i]];
    commanded_[newest_][i] = is_started_ ? target - last_commanded_[i] : 0;
    moved_[i] = is_started_ ? angle - last_measured_[i] : 0;
    last_commanded_[i] = target;
    last_measured_[i] = angle;
  }
  is_started_ = true;
  // error_[j] is the squared difference between the measured increments and those commanded j + 1
  // ticks ago, summed over joints and, with exponential forgetting, over time; motion_ is that of
  // the measured increments alone. The lag is where the error is least.
  accumulate(moved_, 1 - std::min(1.0, dt / kTimeConstant));
  find_minimum(dt);
}

void LagEstimator::accumulate(const std::vector<double>& moved, double decay) {
  motion_ *= decay;
  for (const double angle : moved) motion_ += angle * angle;
  for (int j = 0; j < kMaxTicks; ++j) {
    // The newest command was given one tick ago.
    const std::vector<double>& commanded = commanded_[(newest_ - j + kMaxTicks) % kMaxTicks];
    double sum = 0;
    for (size_t i = 0; i < moved.size(); ++i) {
      sum += (moved[i] - commanded[i]) * (moved[i] - commanded[i]);
    }
    error_[j] = decay * error_[j] + sum;
  }
}

void LagEstimator::find_minimum(double dt) {
  const auto least = std::min_element(error_.begin(), error_.end());
  // A robot at rest gives no information: every lag explains it.
  if (motion_ < kLeastMotion || *least > (1 - kLeastExplained) * motion_) return;
  const auto index = static_cast<int>(least - error_.begin());
  double ticks = index + 1;
  // Interpolate between ticks by the vertex of the parabola through the least error and its two
  // neighbors.
  if (index > 0 && index < kMaxTicks - 1) {
    const double before = error_[index - 1];
    const double after = error_[index + 1];
    const double curvature = before - 2 * *least + after;
    if (curvature > 0) ticks += 0.5 * (before - after) / curvature;
  }
  lag_ += std::min(1.0, dt / kResultTimeConstant) * (ticks * dt - lag_);
}

}  // namespace nao::motion
