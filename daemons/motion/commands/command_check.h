#pragma once

#include <optional>

#include "messages/command.h"
#include "messages/reason.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Checks the values of a command against the robot's description, independent of the robot's
 * state.
 * @return What is wrong; nothing if the command is well formed. */
std::optional<Reason> find_fault(const RobotModel& model, const Command& command);

}  // namespace nao::motion
