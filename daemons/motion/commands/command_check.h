#pragma once

#include <optional>
#include <string>

#include "messages/command.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Looks whether a command makes sense for this robot, whatever the robot is doing.
 * @return What is wrong with it, as a sentence for a person; nothing if it is well formed. */
std::optional<std::string> find_fault(const RobotModel& model, const Command& command);

/** @return What is wrong with a command's sender and number, which a result could not even be
 * remembered for; nothing if they are good. */
std::optional<std::string> find_sender_fault(const Command& command);

}  // namespace nao::motion
