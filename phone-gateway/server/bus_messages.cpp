#include "phone-gateway/server/bus_messages.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "messages/mode.h"

namespace nao {
namespace {

double finite(double value, const char* field) {
  if (!std::isfinite(value)) throw Error(std::string(field) + " is not finite");
  return value;
}

Mode read_mode(int8_t mode) {
  if (mode < 0 || mode >= kNumModes) throw Error("unknown mode " + std::to_string(mode));
  return static_cast<Mode>(mode);
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
  motion.mode = read_mode(message.mode);
  motion.posture = message.posture;
  // The protocol counts command kinds from 1: 0, none, is what an absent field means.
  const int kind = message.command_kind + 1;
  if (!naoremote::CommandKind_IsValid(kind)) {
    throw Error("unknown command kind " + std::to_string(message.command_kind));
  }
  if (kind != naoremote::COMMAND_KIND_NONE || !message.command_name.empty() || message.needs_help) {
    naoremote::Activity& activity = motion.activity.emplace();
    activity.set_kind(static_cast<naoremote::CommandKind>(kind));
    activity.set_name(message.command_name);
    activity.set_needs_help(message.needs_help);
  }
  motion.progress = std::isfinite(message.command_progress) ? message.command_progress : -1;
  motion.velocity = {finite(message.vx, "vx"), finite(message.vy, "vy"), finite(message.wz, "wz")};
  motion.stiffness = finite(message.stiffness, "stiffness");
  return motion;
}

StoredImage read_image(const naolcm::image_t& message) {
  if (message.format != "jpeg") throw Error("an image of format " + message.format);
  if (message.width <= 0 || message.height <= 0) throw Error("an image without size");
  StoredImage image;
  image.utime = message.utime;
  image.camera = message.camera;
  image.width = static_cast<uint32_t>(message.width);
  image.height = static_cast<uint32_t>(message.height);
  image.jpeg.assign(message.data.begin(), message.data.end());
  return image;
}

}  // namespace nao
