#include "daemons/motion/commands/command_check.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace nao::motion {
namespace {

using Fault = std::optional<std::string>;

constexpr size_t kMaxSourceLength = 64;

Fault find_speed_fault(double speed) {
  if (speed > 0 && speed <= 1) return std::nullopt;
  return "The speed must be a fraction of the maximum, above 0 up to 1.";
}

Fault find_fault_in(const RobotModel& /*model*/, const WalkCommand& walk) {
  if (std::isfinite(walk.vx) && std::isfinite(walk.vy) && std::isfinite(walk.wz)) {
    return std::nullopt;
  }
  return "The velocity has something in it that is not a number.";
}

Fault find_fault_in(const RobotModel& /*model*/, const MoveToCommand& move_to) {
  if (std::isfinite(move_to.x) && std::isfinite(move_to.y) && std::isfinite(move_to.theta)) {
    return std::nullopt;
  }
  return "The goal has something in it that is not a number.";
}

Fault find_fault_in(const RobotModel& model, const PostureCommand& posture) {
  if (model.find_posture(posture.posture) == nullptr) {
    std::string known;
    for (const Posture& other : model.postures()) known += (known.empty() ? "" : ", ") + other.name;
    return "There is no posture " + quoted(posture.posture) + "; there are " + known + ".";
  }
  return find_speed_fault(posture.speed);
}

Fault find_fault_in(const RobotModel& model, const JointChangeCommand& change) {
  if (change.joint_names.size() != change.joint_position.size()) {
    return "There are " + std::to_string(change.joint_names.size()) + " joint names but " +
           std::to_string(change.joint_position.size()) + " angles.";
  }
  if (change.joint_names.empty()) return "No joint is named.";
  std::set<std::string> seen;
  for (size_t i = 0; i < change.joint_names.size(); ++i) {
    const std::string& name = change.joint_names[i];
    if (model.find_motor(name) < 0) {
      return model.find_joint(name) >= 0 ? "The joint " + quoted(name) + " has no motor of its own."
                                         : "The robot has no joint " + quoted(name) + ".";
    }
    if (!seen.insert(name).second) return "The joint " + name + " is named twice.";
    if (!std::isfinite(change.joint_position[i])) {
      return "The angle for " + name + " is not a number.";
    }
  }
  return find_speed_fault(change.speed);
}

Fault find_fault_in(const RobotModel& model, const ActionCommand& action) {
  const auto& actions = model.actions();
  if (std::find(actions.begin(), actions.end(), action.action) == actions.end()) {
    std::string known;
    for (const std::string& other : actions) known += (known.empty() ? "" : ", ") + other;
    return "There is no action " + quoted(action.action) + "; there are " + known + ".";
  }
  if (std::isinf(action.ball_x) || std::isinf(action.ball_y)) {
    return "The ball's place is not a number.";
  }
  if (!std::isnan(action.strength) && !(action.strength > 0 && action.strength <= 1)) {
    return "The strength must be above 0 up to 1.";
  }
  return std::nullopt;
}

Fault find_fault_in(const RobotModel& /*model*/, const StopCommand& /*stop*/) {
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const RobotModel& model, const Command& command) {
  return std::visit([&](const auto& request) { return find_fault_in(model, request); },
                    command.request);
}

std::optional<std::string> find_sender_fault(const Command& command) {
  if (command.source.empty()) return "The command does not say who sends it.";
  if (command.source.size() > kMaxSourceLength) {
    return "The sender's name is longer than " + std::to_string(kMaxSourceLength) + " characters.";
  }
  if (command.id == 0) return "The command has the number 0, which means none.";
  return std::nullopt;
}

}  // namespace nao::motion
