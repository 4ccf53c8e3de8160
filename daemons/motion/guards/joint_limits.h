#pragma once

#include <string>
#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Moves every angle to the nearest one that its own and the coupled limits allow.
 * @param position  rad, (num_motors), changed in place. */
void clip_to_limits(const RobotModel& model, std::vector<double>& position);

/** Greatest rates of all motors at a fraction of their maximum speed.
 * @return (num_motors). @param speed  (0, 1]. @param max_acceleration  rad/s^2. */
std::vector<JointRates> joint_rates(const RobotModel& model, double speed, double max_acceleration);

/** Last word on joint targets: never beyond limits, never faster than the motors, never not a
 * number.
 */
class TargetLimiter {
 public:
  /** @param model  Must outlive this. */
  explicit TargetLimiter(const RobotModel& model) : model_(&model) {}

  /** Brings wished targets within reach of the last ones.
   * @param last    rad, (num_motors), within the limits. @param dt  s between the two.
   * @param wished  rad, (num_motors), changed in place: within the limits, and no joint farther
   * from `last` than its maximum speed times dt. */
  void limit(const std::vector<double>& last, double dt, std::vector<double>& wished) const;

 private:
  const RobotModel* model_;
};

}  // namespace nao::motion
