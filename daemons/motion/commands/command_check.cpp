#include "daemons/motion/commands/command_check.h"

#include <cmath>

#include "common/joined.h"
#include "messages/named_joints.h"

namespace nao::motion {
namespace {

using Fault = std::optional<Reason>;

Fault find_speed_fault(double speed) {
  if (speed > 0 && speed <= 1) return std::nullopt;
  return Reason("speed-out-of-range", {to_argument(speed)});
}

// One overload for each kind of command; find_fault() chooses by the variant's type. They check
// what the model knows, before any motion is planned.
Fault find_fault_in(const RobotModel& /*model*/, const WalkCommand& walk) {
  if (std::isfinite(walk.vx) && std::isfinite(walk.vy) && std::isfinite(walk.wz)) {
    return std::nullopt;
  }
  return Reason("velocity-not-finite");
}

Fault find_fault_in(const RobotModel& /*model*/, const MoveToCommand& move_to) {
  if (std::isfinite(move_to.x) && std::isfinite(move_to.y) && std::isfinite(move_to.theta)) {
    return std::nullopt;
  }
  return Reason("goal-not-finite");
}

Fault find_fault_in(const RobotModel& model, const PostureCommand& posture) {
  if (model.find_posture(posture.posture) == nullptr) {
    return Reason("posture-unknown",
                  {quoted(posture.posture), joined(model.postures(), &Posture::name)});
  }
  return find_speed_fault(posture.speed);
}

Fault find_fault_in(const RobotModel& model, const JointChangeCommand& change) {
  if (change.joint_names.empty()) return Reason("joints-missing");
  for (const std::string& name : change.joint_names) {
    // A mimic joint is not an unknown joint: RHipYawPitch follows the motor of LHipYawPitch.
    if (model.find_motor(name) < 0 && model.find_joint(name) >= 0) {
      return Reason("joint-without-motor", {name});
    }
  }
  // Only the faults are of interest here; the values stay in the command.
  std::vector<double> position;
  std::vector<double> stiffness;
  // NaN: the joint keeps its stiffness.
  const std::vector<double> keep_stiffness(change.joint_names.size(), std::nan(""));
  const auto& joint_stiffness =
      change.joint_stiffness.empty() ? keep_stiffness : change.joint_stiffness;
  if (auto fault = read_named_joints(
          model.motor_names(), change.joint_names,
          {{.quantity = "position", .values = change.joint_position, .result = position},
           {.quantity = "stiffness",
            .values = joint_stiffness,
            .result = stiffness,
            .lower = 0,
            .upper = 1,
            .allows_nan = true}},
          JointCoverage::kSubset)) {
    return fault;
  }
  return find_speed_fault(change.speed);
}

Fault find_fault_in(const RobotModel& model, const ActionCommand& action) {
  if (model.find_action(action.action) == nullptr) {
    return Reason("action-unknown",
                  {quoted(action.action), joined(model.actions(), &Action::name)});
  }
  if (std::isinf(action.ball_x) || std::isinf(action.ball_y)) return Reason("ball-not-finite");
  // NaN leaves the strength to the robot's kick file.
  if (!std::isnan(action.strength) && !(action.strength > 0 && action.strength <= 1)) {
    return Reason("strength-out-of-range", {to_argument(action.strength)});
  }
  return std::nullopt;
}

Fault find_fault_in(const RobotModel& /*model*/, const StopCommand& /*stop*/) {
  return std::nullopt;
}

}  // namespace

std::optional<Reason> find_fault(const RobotModel& model, const Command& command) {
  return std::visit([&](const auto& request) { return find_fault_in(model, request); },
                    command.request);
}

}  // namespace nao::motion
