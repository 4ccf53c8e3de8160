#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemons/play/head_control.h"
#include "daemons/play/motion_driver.h"
#include "daemons/play/robot_memory.h"
#include "daemons/play/situation.h"
#include "messages/command_ledger.h"
#include "messages/mode.h"
#include "messages/result_reminder.h"

namespace nao::play {

/** A play_command_t as received. */
struct PlayRequest {
  std::string source;
  int64_t id = 0;
  PlayCommand command;
};

/** Messages that have arrived since the last step. */
struct PlayInput {
  /** Monotonic time, s, for the age of play commands. */
  double now = 0;
  /** Robot time, s. */
  double time = 0;
  std::vector<PlayRequest> requests{};
  /** Results of this program's commands. */
  std::vector<CommandResult> results{};
  /** Kind of a motion command from another sender. */
  std::optional<CommandKind> other_command{};
  Mode mode = Mode::kNoRobot;
  bool needs_help = false;
  /** Nothing: no fresh state of the robot. */
  std::optional<RobotView> robot{};
  Vision vision{};
  /** The robot would play by itself, but a client has driven it: see Autonomy. */
  bool waits_for_release = false;
  /** Nothing: no match, or it is without this robot. */
  std::optional<MatchView> match{};
};

/** Contents of play_state_t, which documents every field. */
struct PlayState {
  Behavior behavior = Behavior::kNone;
  PlayRole role = PlayRole::kNone;
  PlayPhase phase = PlayPhase::kIdle;
  std::string command_source{};
  int64_t command_id = 0;
  std::optional<Eigen::Vector2d> target_in_field{};
  Reason reason{};
};

/** Messages that one step sends. */
struct PlayOutput {
  std::vector<Command> commands;
  std::vector<CommandResult> results;
  /** Camera whose images are needed; empty: none. */
  std::string camera;
  /** The robot may play by itself again. */
  bool is_released = false;
};

/** Runs behaviors without clock and bus: takes play commands, ends commands that nobody repeats,
 * keeps the robot safe, and lets the command's behavior decide. */
class PlayCore {
 public:
  /** Time after which a play command that was not repeated ends the behavior, s: play_command_t. */
  static constexpr double kCommandTimeout = 2;

  /** @param head_joints  Names: yaw and pitch; empty where the robot has none.
   * @param source  Source of the commands, unique on the bus. @param first_id  Number of the first
   * one. */
  PlayCore(const PlayConstants& constants, const HeadLimits& head_limits,
           std::vector<std::string> head_joints, const std::string& source, int64_t first_id);
  // The behaviors refer to the constants.
  PlayCore(const PlayCore&) = delete;
  PlayCore& operator=(const PlayCore&) = delete;

  PlayOutput step(const PlayInput& input);

  const PlayState& state() const { return state_; }
  bool is_active() const { return behavior_ != nullptr; }

 private:
  void take(const PlayRequest& request, const PlayInput& input, PlayOutput& output);
  void begin(const PlayRequest& request, const PlayInput& input, PlayOutput& output);
  std::unique_ptr<BehaviorMachine> make_behavior(const PlayCommand& command) const;
  /** Ends the behavior. @param stops  The robot is to stop, too. */
  void end(ResultStatus status, const Reason& reason, bool stops, double time, PlayOutput& output);
  void report(const PlayRequest& request, ResultStatus status, const Reason& reason,
              PlayOutput& output);
  /** Why the behavior must end now. */
  bool end_if_necessary(const PlayInput& input, PlayOutput& output);
  /** Why the behavior must wait now, with the robot standing. */
  std::optional<Reason> find_obstacle(const PlayInput& input);
  void run(const PlayInput& input, PlayOutput& output);
  void execute(const Decision& decision, const Situation& situation, const PlayInput& input,
               PlayOutput& output);
  Pose2 field_in_odometry() const;
  /** Where other robots are, m, in the odometry frame: seen, or told by teammates. */
  std::vector<Eigen::Vector2d> find_robots(const PlayInput& input) const;

  PlayConstants constants_;
  HeadControl head_;
  MotionDriver motion_;
  PlayState state_;
  PlayRequest request_;
  std::unique_ptr<BehaviorMachine> behavior_;
  CommandLedger ledger_;
  ResultReminder reminder_;
  /** Monotonic times of the last play command and of the last step, s. */
  double last_command_ = -1e9;
  double last_step_ = 0;
  /** Robot time, s, since which the behavior has been waiting for images; nothing if it is not. */
  std::optional<double> waits_since_;
  std::optional<Pose2> last_field_;
  RobotMemory robots_;
  /** Robot time of the last image whose robots are remembered, s. */
  double last_image_ = -1e9;
};

}  // namespace nao::play
