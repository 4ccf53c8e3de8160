#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "messages/command_sender.h"

namespace nao::play {

/** Commands nao-motion: a walk, one action at a time, and at the same time the head. Repeats
 * unanswered commands, and ends what it began. Times are robot times, s. */
class MotionDriver {
 public:
  /** @param head_joints  Yaw and pitch; an empty name: no such joint. */
  MotionDriver(std::string source, int64_t first_id, std::vector<std::string> head_joints)
      : source_(std::move(source)), next_id_(first_id), head_joints_(std::move(head_joints)) {}

  const std::string& source() const { return source_; }

  /** Walks at a velocity; all zero ends the walk. */
  void walk(const WalkCommand& velocity, double time);
  /** Begins an action. @param walks_on  The walk continues; otherwise it ends. */
  void perform(const ActionCommand& action, bool walks_on, double time);
  /** Turns the head: absolute angles, rad, in the order of the joints. */
  void turn_head(const std::vector<double>& angles, double time);
  /** Ends the walk, or the action where that is possible. */
  void stop(double time);
  /** Forgets everything without a command: another sender moves the robot, or it has fallen. */
  void abandon();

  void handle_result(const CommandResult& result, double time);
  /** @return The commands to send now. */
  std::vector<Command> step(double time);

  bool is_walking() const { return walk_id_ != 0; }
  bool is_performing() const { return action_id_ != 0; }
  /** How the last action ended, once. */
  std::optional<CommandResult> take_ended();

 private:
  /** @return Number of the command. */
  int64_t send(decltype(Command::request) request, double time, const CommandTiming& timing);

  std::string source_;
  int64_t next_id_;
  std::vector<std::string> head_joints_;
  CommandSender<Command> sender_;
  /** Numbers of the walk that is being commanded, of the action and of the last walk; 0: none. */
  int64_t walk_id_ = 0;
  int64_t action_id_ = 0;
  int64_t last_walk_id_ = 0;
  int64_t head_id_ = 0;
  std::vector<double> head_angles_;
  double last_head_ = -1e9;
  std::optional<CommandResult> ended_;
};

}  // namespace nao::play
