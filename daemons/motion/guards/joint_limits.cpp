#include "daemons/motion/guards/joint_limits.h"

#include <algorithm>

namespace nao::motion {

void clip_to_limits(const RobotModel& model, std::vector<double>& position) {
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    const Joint& joint = model.motor_joint(motor);
    position[motor] = std::clamp(position[motor], joint.lower, joint.upper);
  }
  // After the independent limits: a coupled range depends on another joint's clipped angle.
  for (const CoupledLimit& limit : model.coupled_limits()) {
    position[limit.motor] = model.clip_to_limits(limit.motor, position[limit.motor], position);
  }
}

std::vector<JointRates> joint_rates(const RobotModel& model, double speed,
                                    double max_acceleration) {
  std::vector<JointRates> rates;
  rates.reserve(model.num_motors());
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    rates.push_back({speed * model.motor_joint(motor).max_velocity, max_acceleration});
  }
  return rates;
}

}  // namespace nao::motion
