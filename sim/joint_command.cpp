#include "sim/joint_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nao::sim {
namespace {

constexpr double kOwn = std::numeric_limits<double>::quiet_NaN();

bool is_number(double value) {
  return !std::isnan(value);
}

}  // namespace

std::optional<std::string> merge_joint_command(const RobotModel& model, const JointCommand& command,
                                               MotorTargets& targets) {
  // A command is taken as a whole or not at all: the targets change only after all joints are
  // checked. The returned text names the first fault; the caller counts and reports it.
  const size_t count = command.names.size();
  if (count != command.position.size() || count != command.stiffness.size()) {
    return fmt::format("lists of unequal length: {} joints, {} positions, {} stiffnesses", count,
                       command.position.size(), command.stiffness.size());
  }
  if ((!command.kp.empty() && command.kp.size() != count) ||
      command.kd.size() != command.kp.size()) {
    return fmt::format("lists of unequal length: {} joints, {} kp, {} kd", count, command.kp.size(),
                       command.kd.size());
  }
  MotorTargets merged = targets;
  if (std::any_of(command.kp.begin(), command.kp.end(), is_number) ||
      std::any_of(command.kd.begin(), command.kd.end(), is_number)) {
    if (merged.kp.size() == 0) merged.kp.setConstant(model.num_motors(), kOwn);
    if (merged.kd.size() == 0) merged.kd.setConstant(model.num_motors(), kOwn);
  }
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
    if (merged.kp.size() == 0 || command.kp.empty()) continue;
    // Written so that NaN passes: it means the servo's own gain.
    if (command.kp[i] < 0 || command.kd[i] < 0 || std::isinf(command.kp[i]) ||
        std::isinf(command.kd[i])) {
      return fmt::format("gains {} and {} of {} must be finite and not negative", command.kp[i],
                         command.kd[i], name);
    }
    merged.kp[motor] = command.kp[i];
    merged.kd[motor] = command.kd[i];
  }
  targets = merged;
  return std::nullopt;
}

}  // namespace nao::sim
