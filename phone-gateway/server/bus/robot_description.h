#pragma once

#include <string>

#include "remote.pb.h"
#include "robot_model/robot_model.h"

namespace nao::gateway {

/** The robot as clients get it.
 * @param name   Name of the robot on the bus, "NAO".
 * @param model  The files that describe it. */
naoremote::RobotDescription describe_robot(const std::string& name, const RobotModel& model);

/** Adds the overview of a simulated world to the robot's cameras. */
void add_overview(naoremote::RobotDescription& robot);

}  // namespace nao::gateway
