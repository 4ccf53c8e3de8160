#pragma once

#include <vector>

#include "robot_model/robot_mechanism.h"

namespace nao {

/** Last limit on joint targets: within the joints' limits, within the motors' speed, and finite.
 * Allocates nothing. */
class TargetLimiter {
 public:
  /** @param model  Must outlive this. */
  explicit TargetLimiter(const RobotMechanism& model) : model_(&model) {}

  /** Limits new targets.
   * @param last    Targets of the last step, rad, (num_motors). @param dt  s between the two.
   * @param target  rad, (num_motors), changed in place: no joint is farther from `last` than its
   *   maximum speed times dt; all are within the limits if `last` was. What is not finite becomes
   *   `last`. */
  void limit(const std::vector<double>& last, double dt, std::vector<double>& target) const;

 private:
  const RobotMechanism* model_;
};

}  // namespace nao
