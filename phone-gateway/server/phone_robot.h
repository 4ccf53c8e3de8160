#pragma once

#include "remote.pb.h"
#include "robot_model/robot_model.h"

namespace nao {

/** The robot as phones see it. */
struct PhoneRobot {
  naoremote::RobotDescription description;
  WalkLimits walk_limits;
};

/** What the robot's files say, in the protocol's terms. @param name  Prefix of its channels. */
PhoneRobot describe_robot(const std::string& name, const RobotModel& model);

}  // namespace nao
