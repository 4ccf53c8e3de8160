#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/motor_targets.h"

namespace nao::sim {

/** Joint targets by name, as joint_command_t carries them. */
struct JointCommand {
  /** Control tick whose sensor state it answers. */
  int64_t tick = 0;
  std::vector<std::string> names;
  /** rad (hands: opening), one for each name; and fractions of the peak torque, 0 to 1. */
  std::vector<double> position;
  std::vector<double> stiffness;
  /** Gains, N m/rad and N m s/rad, 0 or above; NaN: the servo's own. Empty: all are. */
  std::vector<double> kp{};
  std::vector<double> kd{};
};

/** Merges targets for some joints into targets for all; joints that are not named keep theirs.
 *
 * @param targets  Changed only if the whole command is valid.
 * @return Nothing, or why the command is rejected: an unknown joint, a number that is not finite, a
 * stiffness outside [0, 1], a negative gain, or lists of unequal length. */
[[nodiscard]] std::optional<std::string> merge_joint_command(const RobotModel& model,
                                                             const JointCommand& command,
                                                             MotorTargets& targets);

}  // namespace nao::sim
