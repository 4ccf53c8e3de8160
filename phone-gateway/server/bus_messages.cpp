#include "phone-gateway/server/bus_messages.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "messages/command.h"
#include "messages/mode.h"

namespace nao {
namespace {

double finite(double value, const char* field) {
  if (!std::isfinite(value)) throw Error(std::string(field) + " is not finite");
  return value;
}

}  // namespace

RobotStateReader::RobotStateReader(const naoremote::RobotDescription& robot) {
  for (int i = 0; i < robot.joints_size(); ++i) motors_[robot.joints(i).name()] = i;
}

RobotSnapshot RobotStateReader::read(const naolcm::robot_state_t& message) const {
  RobotSnapshot robot;
  robot.utime = message.utime;
  robot.joint_position.assign(motors_.size(), 0);
  size_t num_found = 0;
  for (int i = 0; i < message.num_joints; ++i) {
    const auto motor = motors_.find(message.joint_names[i]);
    if (motor == motors_.end()) continue;
    robot.joint_position[motor->second] = finite(message.joint_position[i], "joint_position");
    ++num_found;
  }
  if (num_found != motors_.size()) {
    throw Error("it names " + std::to_string(num_found) + " of the robot's " +
                std::to_string(motors_.size()) + " joints");
  }
  for (size_t i = 0; i < 4; ++i) {
    robot.torso_orientation[i] =
        finite(message.orientation_torso_in_odometry[i], "orientation_torso_in_odometry");
  }
  for (size_t i = 0; i < 3; ++i) {
    robot.torso_position[i] =
        finite(message.position_torso_in_odometry[i], "position_torso_in_odometry");
  }
  return robot;
}

MotionSnapshot read_motion_state(const naolcm::motion_state_t& message) {
  MotionSnapshot motion;
  motion.mode = to_string(static_cast<Mode>(message.mode));
  motion.posture = message.posture;
  if (message.command_kind != message.COMMAND_KIND_NONE) {
    motion.activity = to_string(static_cast<CommandKind>(message.command_kind));
  }
  const std::string detail = message.needs_help ? "needs help" : message.command_name;
  if (!detail.empty()) {
    motion.activity += (motion.activity.empty() ? "" : " ") + detail;
  }
  motion.progress = std::isfinite(message.command_progress) ? message.command_progress : -1;
  motion.walk_velocity = {finite(message.vx, "vx"), finite(message.vy, "vy"),
                          finite(message.wz, "wz")};
  motion.stiffness = finite(message.stiffness, "stiffness");
  return motion;
}

StoredPicture read_image(const naolcm::image_t& message) {
  if (message.format != "jpeg") throw Error("a picture of format " + message.format);
  if (message.width <= 0 || message.height <= 0) throw Error("a picture without size");
  StoredPicture picture;
  picture.utime = message.utime;
  if (message.camera == "top") {
    picture.camera = naoremote::CAMERA_TOP;
  } else if (message.camera == "bottom") {
    picture.camera = naoremote::CAMERA_BOTTOM;
  } else {
    throw Error("a picture of the camera " + message.camera);
  }
  picture.width = static_cast<uint32_t>(message.width);
  picture.height = static_cast<uint32_t>(message.height);
  picture.jpeg.assign(message.data.begin(), message.data.end());
  return picture;
}

}  // namespace nao
