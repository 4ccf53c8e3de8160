#pragma once

#include <string>

#include "robot_model/robot_model.h"

namespace nao::robot {

/** Sits a robot down whose program has ended, and lets it go limp: connects to LoLA and does what
 * nao-robot does at its end. Blocks, for 10 s at most.
 * @return What was done, for the log. */
std::string take_over(const RobotModel& model, const std::string& lola_socket);

}  // namespace nao::robot
