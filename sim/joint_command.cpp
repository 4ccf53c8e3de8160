#include "sim/joint_command.h"

#include <fmt/format.h>

#include <cmath>

namespace nao::sim {

std::optional<std::string> merge_joint_command(const RobotModel& model, const JointCommand& command,
                                               MotorTargets& targets) {
  // A command is taken as a whole or not at all: the targets change only after all joints are
  // checked. The returned text names the first fault; the caller counts and reports it.
  const size_t count = command.names.size();
  if (count != command.position.size() || count != command.stiffness.size()) {
    return fmt::format("lists of unequal length: {} joints, {} positions, {} stiffnesses", count,
                       command.position.size(), command.stiffness.size());
  }
  MotorTargets merged = targets;
  for (size_t i = 0; i < count; ++i) {
    const std::string& name = command.names[i];
    const int motor = model.find_motor(name);
    if (motor < 0) return "joint \"" + name + "\" is unknown or has no motor";
    if (!std::isfinite(command.position[i])) {
      return fmt::format("position {} of {} is not finite", command.position[i], name);
    }
    // Written so that NaN fails as well.
    if (!(command.stiffness[i] >= 0 && command.stiffness[i] <= 1)) {
      return fmt::format("stiffness {} of {} is outside [0, 1]", command.stiffness[i], name);
    }
    merged.position[motor] = command.position[i];
    merged.stiffness[motor] = command.stiffness[i];
  }
  targets = merged;
  return std::nullopt;
}

}  // namespace nao::sim
