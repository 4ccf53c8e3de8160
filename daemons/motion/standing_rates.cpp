#include "daemons/motion/standing_rates.h"

#include "daemons/motion/guards/joint_limits.h"

namespace nao::motion {

std::vector<JointRates> standing_rates(const MotionContext& context, double speed) {
  const double leg_speed = speed * context.options.posture_leg_speed;
  std::vector<JointRates> rates =
      joint_rates(context.model, speed, context.options.max_acceleration);
  // Legs move the whole robot: slower, with less acceleration, so that it does not tip over.
  const std::vector<JointRates> leg_rates =
      joint_rates(context.model, leg_speed, context.options.max_acceleration * leg_speed);
  for (int motor = 0; motor < context.model.num_motors(); ++motor) {
    if (carries_body(context, motor)) rates[motor] = leg_rates[motor];
  }
  return rates;
}

std::vector<JointRates> stopping_rates(const MotionContext& context) {
  std::vector<JointRates> rates = joint_rates(context.model, 1, context.options.max_acceleration);
  for (int motor = 0; motor < context.model.num_motors(); ++motor) {
    if (!carries_body(context, motor)) {
      rates[motor].max_acceleration = context.options.free_acceleration;
    }
  }
  return rates;
}

bool carries_body(const MotionContext& context, int motor) {
  for (int sole : {context.model.left_sole(), context.model.right_sole()}) {
    // A column of a sole's Jacobian that is not 0: the joint is between torso and sole.
    if (!context.kinematics.calc_angular_jacobian(sole).col(motor).isZero(0)) return true;
  }
  return false;
}

}  // namespace nao::motion
