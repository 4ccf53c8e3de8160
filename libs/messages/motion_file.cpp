#include "messages/motion_file.h"

#include <algorithm>
#include <limits>

namespace nao {
namespace {

/** Characters. Chosen: short enough for a line of a list. */
constexpr size_t kMaxNameLength = 40;

}  // namespace

bool is_motion_name(const std::string& text) {
  constexpr const char* kAllowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  return !text.empty() && text.size() <= kMaxNameLength &&
         text.find_first_not_of(kAllowed) == std::string::npos;
}

naolcm::keyframe_motion_t to_message(const NamedMotion& motion) {
  naolcm::keyframe_motion_t message{};
  message.name = motion.name;
  message.start_posture = motion.start;
  message.num_repetitions = motion.num_repetitions;
  message.num_joints = static_cast<int32_t>(motion.joint_names.size());
  message.joint_names = motion.joint_names;
  message.num_keyframes = static_cast<int32_t>(motion.keyframes.size());
  for (const NamedMotion::Keyframe& keyframe : motion.keyframes) {
    message.duration.push_back(keyframe.duration);
    message.pause.push_back(keyframe.pause);
    message.joint_position.insert(message.joint_position.end(), keyframe.position.begin(),
                                  keyframe.position.end());
    message.joint_stiffness.insert(message.joint_stiffness.end(), keyframe.stiffness.begin(),
                                   keyframe.stiffness.end());
  }
  message.num_values = static_cast<int32_t>(message.joint_position.size());
  message.joint_stiffness.resize(message.joint_position.size(),
                                 std::numeric_limits<double>::quiet_NaN());
  return message;
}

naolcm::motion_file_command_t to_message(const MotionFileCommand& command) {
  naolcm::motion_file_command_t message{};
  message.source = command.source;
  message.command_id = command.id;
  message.operation = static_cast<int8_t>(command.operation);
  message.name = command.name;
  message.may_replace = command.may_replace ? 1 : 0;
  message.yaml = command.yaml;
  message.motion = to_message(command.motion);
  return message;
}

naolcm::motion_file_result_t to_message(const MotionFileResult& result) {
  naolcm::motion_file_result_t message{};
  message.source = result.source;
  message.command_id = result.id;
  message.is_ok = result.is_ok ? 1 : 0;
  message.keyframe = result.keyframe;
  message.reason_code = result.reason.code;
  message.num_reason_arguments = static_cast<int32_t>(result.reason.arguments.size());
  message.reason_arguments = result.reason.arguments;
  message.reason = to_sentence(result.reason);
  message.motion = to_message(result.motion);
  message.yaml = result.yaml;
  message.repair = result.repair;
  message.num_motions = static_cast<int32_t>(result.names.size());
  message.motion_names = result.names;
  return message;
}

std::optional<NamedMotion> from_message(const naolcm::keyframe_motion_t& message) {
  const auto num_joints = static_cast<size_t>(std::max(0, message.num_joints));
  const auto num_keyframes = static_cast<size_t>(std::max(0, message.num_keyframes));
  // Compared by division: the product of two received numbers may overflow.
  const auto num_values = static_cast<size_t>(std::max(0, message.num_values));
  const bool matches =
      num_keyframes == 0 || num_joints == 0
          ? num_values == 0
          : num_values % num_joints == 0 && num_values / num_joints == num_keyframes;
  if (!matches) return std::nullopt;
  NamedMotion motion;
  motion.name = message.name;
  motion.start = message.start_posture;
  motion.num_repetitions = message.num_repetitions;
  motion.joint_names = message.joint_names;
  for (size_t k = 0; k < num_keyframes; ++k) {
    const auto row = [&](const std::vector<double>& values) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k * num_joints);
      return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(num_joints));
    };
    motion.keyframes.push_back({message.duration[k], message.pause[k], row(message.joint_position),
                                row(message.joint_stiffness)});
  }
  return motion;
}

std::optional<MotionFileCommand> from_message(const naolcm::motion_file_command_t& message) {
  const bool is_known = message.operation >= naolcm::motion_file_command_t::OPERATION_CHECK &&
                        message.operation <= naolcm::motion_file_command_t::OPERATION_GET;
  auto motion = from_message(message.motion);
  if (!is_known || !motion) return std::nullopt;
  MotionFileCommand command;
  command.source = message.source;
  command.id = message.command_id;
  command.operation = static_cast<MotionFileOperation>(message.operation);
  command.name = message.name;
  command.may_replace = message.may_replace != 0;
  command.yaml = message.yaml;
  command.motion = *std::move(motion);
  return command;
}

std::optional<MotionFileResult> from_message(const naolcm::motion_file_result_t& message) {
  auto motion = from_message(message.motion);
  if (!motion) return std::nullopt;
  MotionFileResult result;
  result.source = message.source;
  result.id = message.command_id;
  result.is_ok = message.is_ok != 0;
  result.keyframe = message.keyframe;
  result.reason.code = message.reason_code;
  result.reason.arguments = message.reason_arguments;
  result.sentence = message.reason;
  result.motion = *std::move(motion);
  result.yaml = message.yaml;
  result.repair = message.repair;
  result.names = message.motion_names;
  return result;
}

}  // namespace nao
