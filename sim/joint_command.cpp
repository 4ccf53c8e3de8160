#include "sim/joint_command.h"

#include <cmath>

namespace nao::sim {

std::optional<std::string> merge_joint_command(const RobotModel& model,
                                               const std::vector<std::string>& names,
                                               const std::vector<double>& position,
                                               const std::vector<double>& stiffness,
                                               MotorTargets& targets) {
  if (names.size() != position.size() || names.size() != stiffness.size()) {
    return "lists of joints, positions and stiffness have unequal lengths";
  }
  MotorTargets merged = targets;
  for (size_t i = 0; i < names.size(); ++i) {
    const int motor = model.find_motor(names[i]);
    if (motor < 0) return "joint \"" + names[i] + "\" is unknown or has no motor";
    if (!std::isfinite(position[i])) return "position of " + names[i] + " is no finite number";
    if (!(stiffness[i] >= 0 && stiffness[i] <= 1)) {
      return "stiffness of " + names[i] + " is outside 0..1";
    }
    merged.position[motor] = position[i];
    merged.stiffness[motor] = stiffness[i];
  }
  targets = merged;
  return std::nullopt;
}

}  // namespace nao::sim
