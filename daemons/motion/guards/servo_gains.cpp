#include "daemons/motion/guards/servo_gains.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

// Time in which a gain changes from one value to another at least, s. Chosen: longer than the
// transient of a servo, shorter than a step of a walk.
constexpr double kChangeTime = 0.2;

/** Moves a gain towards another. @return Whether it is there. */
bool approach(double goal, double own, double dt, double& gain) {
  const double step = std::max({goal, own, gain}) * dt / kChangeTime;
  gain += std::clamp(goal - gain, -step, step);
  return gain == goal;
}

/** The wanted gain of a motor; NaN and missing mean its own. */
double wanted(const std::vector<double>& gains, size_t motor, double own) {
  return gains.empty() || std::isnan(gains[motor]) ? own : gains[motor];
}

}  // namespace

void ServoGains::limit(double dt, JointTargets& targets) {
  if (targets.kp.empty() && kp_.empty()) return;
  const auto count = static_cast<size_t>(model_->num_motors());
  if (kp_.empty()) {
    kp_.resize(count);
    kd_.resize(count);
    for (size_t i = 0; i < count; ++i) {
      kp_[i] = model_->motor(static_cast<int>(i)).stiffness_gain;
      kd_[i] = model_->motor(static_cast<int>(i)).damping_gain;
    }
  }
  bool are_own = targets.kp.empty();
  for (size_t i = 0; i < count; ++i) {
    const Motor& motor = model_->motor(static_cast<int>(i));
    const double kp = wanted(targets.kp, i, motor.stiffness_gain);
    const double kd = wanted(targets.kd, i, motor.damping_gain);
    const bool is_kp_there = approach(kp, motor.stiffness_gain, dt, kp_[i]);
    const bool is_kd_there = approach(kd, motor.damping_gain, dt, kd_[i]);
    are_own &= is_kp_there && is_kd_there;
  }
  if (are_own) reset();
  targets.kp = kp_;
  targets.kd = kp_.empty() ? kp_ : kd_;
}

}  // namespace nao::motion
