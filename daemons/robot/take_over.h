#pragma once

#include <string>

#include "robot_model/robot_model.h"

namespace nao::robot {

/** Makes a robot whose program has ended sit down and go limp: connects to LoLA and does what
 * nao-robot does at its end. Blocks for at most 10 s.
 * @return What was done, for the log. */
std::string take_over(const RobotModel& model, const std::string& lola_socket);

}  // namespace nao::robot
