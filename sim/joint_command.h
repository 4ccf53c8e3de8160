#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/sim_robot.h"

namespace nao::sim {

/** Targets for some joints by name, merged into targets for all; the joints not named keep theirs.
 *
 * @param position   rad (hands: opening), one for each name. @param stiffness  0 to 1, likewise.
 * @param targets    Changed only if the command is good as a whole.
 * @return Nothing, or why the command is refused: an unknown joint, a number that is not finite or
 * a stiffness outside 0..1, lists of unequal length. */
[[nodiscard]] std::optional<std::string> merge_joint_command(const RobotModel& model,
                                                             const std::vector<std::string>& names,
                                                             const std::vector<double>& position,
                                                             const std::vector<double>& stiffness,
                                                             MotorTargets& targets);

}  // namespace nao::sim
