#include "robot_model/target_limiter.h"

#include <algorithm>
#include <cmath>

namespace nao {

void TargetLimiter::limit(const std::vector<double>& last, double dt,
                          std::vector<double>& target) const {
  for (int motor = 0; motor < model_->num_motors(); ++motor) {
    const Joint& joint = model_->motor_joint(motor);
    const double step = joint.max_velocity * dt;
    // A target that is not a number keeps the last one: it must not reach a servo.
    if (!std::isfinite(target[motor])) target[motor] = last[motor];
    target[motor] = std::clamp(target[motor], joint.lower, joint.upper);
    target[motor] = std::clamp(target[motor], last[motor] - step, last[motor] + step);
  }
  // Coupled limits after the single ones: they depend on the other joint's limited target.
  for (const CoupledLimit& limit : model_->coupled_limits()) {
    const double step = model_->motor_joint(limit.motor).max_velocity * dt;
    // The factor allows for rounding of the difference.
    const auto is_in_reach = [&](double angle) {
      return std::abs(angle - last[limit.motor]) <= step * (1 + 1e-12);
    };
    double angle = model_->clip_to_limits(limit.motor, target[limit.motor], target);
    if (!is_in_reach(angle)) {
      // The range moves faster than this joint can follow: the other joint keeps its last target.
      target[limit.other_motor] = last[limit.other_motor];
      angle = model_->clip_to_limits(limit.motor, target[limit.motor], target);
    }
    // Still out of reach only if the last targets were out of the range, as after the robot was
    // moved by hand: the joint approaches the range at its maximum speed.
    target[limit.motor] = std::clamp(angle, last[limit.motor] - step, last[limit.motor] + step);
  }
}

}  // namespace nao
