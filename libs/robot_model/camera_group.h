#pragma once

#include "robot_model/robot_model.h"

namespace nao {

/** The joints that turn the first camera: the group of the first joint between root and camera.
 * @return nullptr if the robot has no camera, or one that no group turns. */
const JointGroup* find_camera_group(const RobotModel& model);

}  // namespace nao
