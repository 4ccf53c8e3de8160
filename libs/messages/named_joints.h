#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/reason.h"

namespace nao {

/** One list of a message that has a value for each named joint, and where its values go. */
struct NamedJointValues {
  /** What the values are, for the fault: "position". */
  const char* quantity;
  /** (number of joint names). */
  const std::vector<double>& values;
  /** Gets the values in the robot's joint order. Resized to the number of the robot's joints; a
   * joint that the message does not name keeps its value. */
  std::vector<double>& result;
  /** Allowed range. */
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /** NaN is allowed, for fields that give it a meaning ("keep"). Infinity never is. */
  bool allows_nan = false;
};

/** Which of the robot's joints a message must name. */
enum class JointCoverage { kAll, kSubset };

/** Copies values that a message lists by joint name into the robot's joint order.
 *
 * @param robot_joints  Names in the robot's order, as of RobotModel::motor_names().
 * @param names         Names as the message lists them.
 * @param lists         The message's lists of values, one value for each name.
 * @return Nothing, or the fault, which names the joint: "joint-lists-unequal", "joint-unknown",
 *   "joint-repeated", "joint-value-not-finite", "joint-value-out-of-range" or, unless a subset is
 *   allowed, "joint-missing". With a fault no result changes. */
[[nodiscard]] std::optional<Reason> read_named_joints(const std::vector<std::string>& robot_joints,
                                                      const std::vector<std::string>& names,
                                                      std::initializer_list<NamedJointValues> lists,
                                                      JointCoverage coverage = JointCoverage::kAll);

}  // namespace nao
