#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "messages/reason.h"

namespace nao {

/** m/s ahead, m/s to the left, rad/s to the left. All zero ends the walk. */
struct WalkCommand {
  double vx = 0;
  double vy = 0;
  double wz = 0;
};

/** Goal on the ground relative to where the robot stands: m, m, rad. */
struct MoveToCommand {
  double x = 0;
  double y = 0;
  double theta = 0;
};

/** Speed is a fraction of the maximum, (0, 1]. */
struct PostureCommand {
  std::string posture;
  double speed = 0;
};

/** Turn joints by, or to, angles in rad (hands: opening). */
struct JointChangeCommand {
  std::vector<std::string> joint_names;
  std::vector<double> joint_position;
  bool is_relative = false;
  double speed = 0;
  bool allow_tipping = false;
  /** Fraction of the peak torque, 0..1; NaN keeps the present one. Empty: all NaN. */
  std::vector<double> joint_stiffness{};
};

/** NaN in a number: as the action says. */
struct ActionCommand {
  std::string action;
  double ball_x = 0;
  double ball_y = 0;
  double strength = 0;
};

struct StopCommand {};

/** A command; see the messages of the same names for every field. */
struct Command {
  /** Sender, and its number for this command. */
  std::string source;
  int64_t id = 0;
  /** In the order of CommandKind. */
  std::variant<WalkCommand, MoveToCommand, PostureCommand, JointChangeCommand, ActionCommand,
               StopCommand>
      request;
};

/** The values are those of command_result_t::COMMAND_KIND_*. */
enum class CommandKind { kWalk, kMoveTo, kPosture, kJointChange, kAction, kStop };

inline constexpr int kNumCommandKinds = 6;

inline CommandKind kind_of(const Command& command) {
  return static_cast<CommandKind>(command.request.index());
}

/** Name for logs and people: "joint-change"; "unknown" for a value outside the enumeration. */
const char* to_string(CommandKind kind);

/** What a command asks for, in words for a person: "Crouch", "kick-left", "HeadYaw, HeadPitch". */
std::string describe(const Command& command);

/** A received text quoted for a sentence: at most 40 characters, unprintable ones as '?'. */
std::string quoted(const std::string& text);

/** The values are those of command_result_t::STATUS_*. */
enum class ResultStatus { kAccepted, kRefused, kDone, kInterrupted, kFailed };

/** Name for logs and people: "interrupted"; "unknown" for a value outside the enumeration. */
const char* to_string(ResultStatus status);

/** Result of a command. */
struct CommandResult {
  std::string source;
  int64_t id = 0;
  CommandKind kind = CommandKind::kStop;
  ResultStatus status = ResultStatus::kAccepted;
  /** Why the command was refused, interrupted or failed; of one that is done a remark. */
  Reason reason{};
};

}  // namespace nao
