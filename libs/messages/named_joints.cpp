#include "messages/named_joints.h"

#include <algorithm>
#include <cmath>

#include "messages/command.h"

namespace nao {
namespace {

/** Index of a name; robot_joints.size() if there is none. Messages usually list the joints in the
 * robot's order, so `guess` is tried first. */
size_t find_joint(const std::vector<std::string>& robot_joints, const std::string& name,
                  size_t guess) {
  if (guess < robot_joints.size() && robot_joints[guess] == name) return guess;
  return std::find(robot_joints.begin(), robot_joints.end(), name) - robot_joints.begin();
}

std::optional<Reason> find_value_fault(const NamedJointValues& list, const std::string& joint,
                                       double value) {
  if (std::isnan(value) && list.allows_nan) return std::nullopt;
  if (!std::isfinite(value)) return Reason("joint-value-not-finite", {joint, list.quantity});
  if (value < list.lower || value > list.upper) {
    return Reason("joint-value-out-of-range", {joint, list.quantity, to_argument(value),
                                               to_argument(list.lower), to_argument(list.upper)});
  }
  return std::nullopt;
}

}  // namespace

std::optional<Reason> read_named_joints(const std::vector<std::string>& robot_joints,
                                        const std::vector<std::string>& names,
                                        std::initializer_list<NamedJointValues> lists,
                                        JointCoverage coverage) {
  for (const NamedJointValues& list : lists) {
    if (list.values.size() == names.size()) continue;
    return Reason("joint-lists-unequal", {std::to_string(names.size()), list.quantity,
                                          std::to_string(list.values.size())});
  }

  // Everything is checked before the first result changes.
  std::vector<size_t> joints(names.size());
  std::vector<bool> is_listed(robot_joints.size(), false);
  for (size_t i = 0; i < names.size(); ++i) {
    joints[i] = find_joint(robot_joints, names[i], i);
    if (joints[i] == robot_joints.size()) return Reason("joint-unknown", {quoted(names[i])});
    if (is_listed[joints[i]]) return Reason("joint-repeated", {names[i]});
    is_listed[joints[i]] = true;
    for (const NamedJointValues& list : lists) {
      if (auto fault = find_value_fault(list, names[i], list.values[i])) return fault;
    }
  }
  const auto missing = std::find(is_listed.begin(), is_listed.end(), false);
  if (coverage == JointCoverage::kAll && missing != is_listed.end()) {
    return Reason("joint-missing", {robot_joints[missing - is_listed.begin()]});
  }

  for (const NamedJointValues& list : lists) {
    // Joints that are not named keep what the result held.
    list.result.resize(robot_joints.size());
    for (size_t i = 0; i < names.size(); ++i) list.result[joints[i]] = list.values[i];
  }
  return std::nullopt;
}

}  // namespace nao
