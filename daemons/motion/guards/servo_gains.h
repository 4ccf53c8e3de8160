#pragma once

#include <vector>

#include "daemons/motion/joint_targets.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Gains of the servos in transition: a motion may command its own, but none changes at once, since
 * the torque of a loaded joint would jump with it. */
class ServoGains {
 public:
  /** @param model  Must outlive this. */
  explicit ServoGains(const RobotModel& model) : model_(&model) {}

  /** The servos have their own gains. */
  void reset() { kp_.clear(); }

  /** One control step. @param targets  In: gains as the motion commands them, or empty. Out: gains
   * to send; empty if all are the servos' own. @param dt  s. */
  void limit(double dt, JointTargets& targets);

 private:
  const RobotModel* model_;
  /** As sent in the last step; empty: the servos' own. */
  std::vector<double> kp_;
  std::vector<double> kd_;
};

}  // namespace nao::motion
