#pragma once

#include <cstdint>
#include <naolcm/keyframe_motion_t.hpp>
#include <naolcm/motion_file_command_t.hpp>
#include <naolcm/motion_file_result_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "messages/reason.h"

namespace nao {

/** A taught motion with its joints by name; keyframe_motion_t documents every field. */
struct NamedMotion {
  struct Keyframe {
    /** s. */
    double duration = 0;
    double pause = 0;
    /** rad, and fraction of the peak torque, (joint_names.size()); NaN: as before. */
    std::vector<double> position;
    std::vector<double> stiffness;
  };

  std::string name;
  /** A posture; empty: the upright or sitting one nearest to the first keyframe. */
  std::string start{};
  int num_repetitions = 1;
  std::vector<std::string> joint_names{};
  std::vector<Keyframe> keyframes{};
};

/** The values are those of motion_file_command_t::OPERATION_*. */
enum class MotionFileOperation { kCheck, kSave, kDelete, kList, kGet };

/** A command about saved motions; motion_file_command_t documents every field. */
struct MotionFileCommand {
  std::string source;
  int64_t id = 0;
  MotionFileOperation operation = MotionFileOperation::kList;
  std::string name{};
  bool may_replace = false;
  std::string yaml{};
  NamedMotion motion{};
};

/** Its answer; motion_file_result_t documents every field. */
struct MotionFileResult {
  std::string source;
  int64_t id = 0;
  bool is_ok = true;
  int keyframe = -1;
  Reason reason{};
  /** The reason as the English sentence of a received message; empty where the result is made. */
  std::string sentence{};
  NamedMotion motion{};
  std::string yaml{};
  std::string repair{};
  std::vector<std::string> names{};
};

/** Whether a text is a name of a motion: 1 to 40 letters, digits, '-' and '_'. */
bool is_motion_name(const std::string& text);

/** Whether a motion of this name is kept until nao-motion ends only, and not listed. */
inline bool is_temporary_motion(const std::string& name) {
  return name.starts_with('_');
}

naolcm::keyframe_motion_t to_message(const NamedMotion& motion);
naolcm::motion_file_command_t to_message(const MotionFileCommand& command);
naolcm::motion_file_result_t to_message(const MotionFileResult& result);

/** @return Nothing if the lengths of the lists do not match one another. */
std::optional<NamedMotion> from_message(const naolcm::keyframe_motion_t& message);
/** @return Nothing if the operation is unknown, or the motion's lists do not match. */
std::optional<MotionFileCommand> from_message(const naolcm::motion_file_command_t& message);
std::optional<MotionFileResult> from_message(const naolcm::motion_file_result_t& message);

}  // namespace nao
