#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "messages/reason.h"

namespace nao {

/** Commanded velocity: m/s forward, m/s to the left, rad/s counter-clockwise. All zero ends the
 * walk. */
struct WalkCommand {
  double vx = 0;
  double vy = 0;
  double wz = 0;
};

/** Whether the command ends a walk. */
inline bool is_zero(const WalkCommand& velocity) {
  return velocity.vx == 0 && velocity.vy == 0 && velocity.wz == 0;
}

/** Goal on the ground relative to the robot's present pose: m forward, m to the left, rad. */
struct MoveToCommand {
  double x = 0;
  double y = 0;
  double theta = 0;
};

/** Goes to a posture. */
struct PostureCommand {
  std::string posture;
  /** Fraction of the maximum, (0, 1]. */
  double speed = 0;
};

/** Turns single joints. */
struct JointChangeCommand {
  std::vector<std::string> joint_names;
  /** Changes or target angles, rad (hands: opening). */
  std::vector<double> joint_position;
  /** The positions are changes. */
  bool is_relative = false;
  /** Fraction of the maximum, (0, 1]. */
  double speed = 0;
  /** Executes the change even if the robot would tip over. */
  bool allow_tipping = false;
  /** Fraction of the peak torque, 0..1; NaN keeps the present one. Empty: all NaN. */
  std::vector<double> joint_stiffness{};
};

/** Executes an action by its name. NaN in a number: the action's own value. */
struct ActionCommand {
  std::string action;
  /** Ball on the ground, m forward and to the left of the midpoint between the soles. */
  double ball_x = 0;
  double ball_y = 0;
  /** Strength of a kick, (0, 1]. */
  double strength = 0;
};

/** Ends any motion. */
struct StopCommand {};

/** A command; the messages of the same names document every field. */
struct Command {
  /** Sender, and its number for this command. */
  std::string source;
  int64_t id = 0;
  /** In the order of the first CommandKinds. */
  std::variant<WalkCommand, MoveToCommand, PostureCommand, JointChangeCommand, ActionCommand,
               StopCommand>
      request;
};

/** The values are those of command_result_t::COMMAND_KIND_*. */
enum class CommandKind {
  kWalk,
  kMoveTo,
  kPosture,
  kJointChange,
  kAction,
  kStop,
  // Not executed by nao-motion.
  kPlay,
  kSpeech,
  kLight,
  // Executed by nao-referee; the values between are of messages that are answered otherwise.
  kMatch = 11,
};

/** Those that nao-motion executes: the first ones. */
inline constexpr int kNumCommandKinds = 6;

inline CommandKind kind_of(const Command& command) {
  return static_cast<CommandKind>(command.request.index());
}

/** Name for logs and users: "joint-change"; "unknown" for a value outside the enumeration. */
const char* to_string(CommandKind kind);

/** Checks source and number of a command. With a fault in them no result can be remembered.
 * @return What is wrong; nothing if they are well formed. */
std::optional<Reason> check_sender(const std::string& source, int64_t id);

/** Content of a command in short, as in motion_state_t::command_name: "Crouch", "kick-left",
 * "HeadYaw, HeadPitch". */
std::string describe(const Command& command);

/** A received text in quotation marks: at most 40 characters, unprintable ones as '?'. */
std::string quoted(const std::string& text);

/** The values are those of command_result_t::STATUS_*. */
enum class ResultStatus { kAccepted, kRefused, kDone, kInterrupted, kFailed };

/** Name for logs and users: "interrupted"; "unknown" for a value outside the enumeration. */
const char* to_string(ResultStatus status);

/** Result of a command. */
struct CommandResult {
  std::string source;
  int64_t id = 0;
  CommandKind kind = CommandKind::kStop;
  ResultStatus status = ResultStatus::kAccepted;
  /** Why the command was refused, interrupted or failed; of one that is done a remark. */
  Reason reason{};
  /** The reason as the English sentence of a received message; empty where the result is made. */
  std::string sentence{};
};

}  // namespace nao
