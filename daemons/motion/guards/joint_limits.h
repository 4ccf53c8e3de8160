#pragma once

#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "robot_model/robot_model.h"
#include "robot_model/target_limiter.h"

namespace nao::motion {

/** Moves every angle to the nearest one within its own and the coupled limits.
 * @param position  rad, (num_motors), changed in place. */
void clip_to_limits(const RobotModel& model, std::vector<double>& position);

/** Rates of all motors at a fraction of their maximum speed.
 * @param speed  (0, 1]. @param max_acceleration  rad/s^2. @return (num_motors). */
std::vector<JointRates> joint_rates(const RobotModel& model, double speed, double max_acceleration);

}  // namespace nao::motion
