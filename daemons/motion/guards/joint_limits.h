#pragma once

#include <vector>

#include "daemons/motion/generators/joint_trajectory.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Moves every angle to the nearest one within its own and the coupled limits.
 * @param position  rad, (num_motors), changed in place. */
void clip_to_limits(const RobotModel& model, std::vector<double>& position);

/** Rates of all motors at a fraction of their maximum speed.
 * @param speed  (0, 1]. @param max_acceleration  rad/s^2. @return (num_motors). */
std::vector<JointRates> joint_rates(const RobotModel& model, double speed, double max_acceleration);

/** Last limit on joint targets: within the joints' limits, within the motors' speed, and finite. */
class TargetLimiter {
 public:
  /** @param model  Must outlive this. */
  explicit TargetLimiter(const RobotModel& model) : model_(&model) {}

  /** Limits new targets.
   * @param last    Targets of the last step, rad, (num_motors). @param dt  s between the two.
   * @param target  rad, (num_motors), changed in place: no joint is farther from `last` than its
   *   maximum speed times dt; all are within the limits if `last` was. What is not finite becomes
   *   `last`. */
  void limit(const std::vector<double>& last, double dt, std::vector<double>& target) const;

 private:
  const RobotModel* model_;
};

}  // namespace nao::motion
