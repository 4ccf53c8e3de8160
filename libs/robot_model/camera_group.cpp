#include "robot_model/camera_group.h"

namespace nao {

const JointGroup* find_camera_group(const RobotModel& model) {
  if (model.cameras().empty()) return nullptr;
  for (const int joint : model.find_chain(model.cameras().front().link)) {
    const int motor = model.motor_of(joint);
    for (const JointGroup& group : model.joint_groups()) {
      if (motor >= 0 && (group.yaw_motor == motor || group.pitch_motor == motor)) return &group;
    }
  }
  return nullptr;
}

}  // namespace nao
