#include "phone-gateway/server/bus/bus_messages.h"

#include <cmath>

#include "common/error.h"
#include "messages/mode.h"
#include "messages/named_joints.h"

namespace nao::gateway {
namespace {

double finite(double value, const char* field) {
  if (!std::isfinite(value)) throw Error(std::string(field) + " is not finite");
  return value;
}

Mode read_mode(int8_t mode) {
  if (mode < 0 || mode >= kNumModes) throw Error("unknown mode " + std::to_string(mode));
  return static_cast<Mode>(mode);
}

/** The protocol's enumeration begins with NONE = 0, that of motion_state_t with NONE = -1. */
naoremote::CommandKind read_activity_kind(int8_t kind) {
  static_assert(naolcm::motion_state_t::COMMAND_KIND_NONE + 1 == naoremote::COMMAND_KIND_NONE);
  static_assert(naolcm::motion_state_t::COMMAND_KIND_STOP + 1 == naoremote::COMMAND_KIND_STOP);
  if (!naoremote::CommandKind_IsValid(kind + 1)) {
    throw Error("unknown command kind " + std::to_string(kind));
  }
  return static_cast<naoremote::CommandKind>(kind + 1);
}

}  // namespace

RobotStateReader::RobotStateReader(const naoremote::RobotDescription& robot) {
  for (const naoremote::Joint& joint : robot.joints()) joint_names_.push_back(joint.name());
}

RobotSnapshot RobotStateReader::read(const naolcm::robot_state_t& message) const {
  RobotSnapshot robot;
  robot.utime = message.utime;
  if (const auto fault =
          read_named_joints(joint_names_, message.joint_names,
                            {{"position", message.joint_position, robot.joint_position}})) {
    throw Error(to_sentence(*fault));
  }
  for (size_t i = 0; i < robot.torso_orientation.size(); ++i) {
    robot.torso_orientation[i] =
        finite(message.orientation_torso_in_odometry[i], "orientation_torso_in_odometry");
  }
  for (size_t i = 0; i < robot.torso_position.size(); ++i) {
    robot.torso_position[i] =
        finite(message.position_torso_in_odometry[i], "position_torso_in_odometry");
  }
  return robot;
}

MotionSnapshot read_motion_state(const naolcm::motion_state_t& message) {
  MotionSnapshot motion;
  motion.mode = read_mode(message.mode);
  motion.posture = message.posture;
  const naoremote::CommandKind kind = read_activity_kind(message.command_kind);
  const bool has_activity = kind != naoremote::COMMAND_KIND_NONE || !message.command_name.empty() ||
                            message.needs_help != 0;
  if (has_activity) {
    naoremote::Activity& activity = motion.activity.emplace();
    activity.set_kind(kind);
    activity.set_name(message.command_name);
    activity.set_needs_help(message.needs_help != 0);
  }
  motion.progress = std::isfinite(message.command_progress) ? message.command_progress : -1;
  motion.velocity = {finite(message.vx, "vx"), finite(message.vy, "vy"), finite(message.wz, "wz")};
  motion.stiffness = finite(message.stiffness, "stiffness");
  return motion;
}

CachedImage read_image(const naolcm::image_t& message) {
  if (message.format != "jpeg") throw Error("an image of format " + quoted(message.format));
  if (message.width <= 0 || message.height <= 0) throw Error("an image without size");
  CachedImage image;
  image.utime = message.utime;
  image.camera = message.camera;
  image.width = static_cast<uint32_t>(message.width);
  image.height = static_cast<uint32_t>(message.height);
  image.jpeg.assign(message.data.begin(), message.data.end());
  return image;
}

CommandResult read_result(const naolcm::command_result_t& message) {
  if (message.command_kind < 0 || message.command_kind >= kNumCommandKinds) {
    throw Error("unknown command kind " + std::to_string(message.command_kind));
  }
  if (message.status < message.STATUS_ACCEPTED || message.status > message.STATUS_FAILED) {
    throw Error("unknown result status " + std::to_string(message.status));
  }
  CommandResult result;
  result.source = message.source;
  result.id = message.command_id;
  result.kind = static_cast<CommandKind>(message.command_kind);
  result.status = static_cast<ResultStatus>(message.status);
  result.reason.code = message.reason_code;
  result.reason.arguments = message.reason_arguments;
  result.sentence = message.reason;
  return result;
}

}  // namespace nao::gateway
