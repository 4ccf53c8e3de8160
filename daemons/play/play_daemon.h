#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/channels.h"
#include "common/status_reporter.h"
#include "common/wall_clock.h"
#include "daemons/play/autonomy.h"
#include "daemons/play/play_core.h"
#include "daemons/play/play_messages.h"
#include "daemons/play/robot_viewer.h"
#include "messages/command_publisher.h"

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::play {

struct PlayOptions {
  /** Prefix of the channels. */
  std::string robot = "NAO";
  /** With a field. */
  std::string scene = "soccer";
  /** Where the robot stood on the field when nao-motion started, m and rad. */
  Pose2 start_in_field{};
  /** Whether the robot plays by itself in a match, unless a person drives it. */
  bool is_autonomous = false;
};

/** Connects PlayCore to the bus: receives NAO_PLAY_COMMAND, NAO_VISION_STATE, NAO_ROBOT_STATE,
 * MATCH_STATE, the teammates' NAO_VISION_STATE, NAO_MOTION_STATE, NAO_COMMAND_RESULT and the motion
 * commands of others; publishes motion commands, NAO_HEAD_CAMERA_COMMAND while a behavior runs,
 * NAO_PLAY_STATE and NAO_COMMAND_RESULT.
 */
class PlayDaemon {
 public:
  /** Time between two steps, and between two play_state_t, s. */
  static constexpr double kStepPeriod = 0.05;
  static constexpr double kStatePeriod = 0.2;

  /** @param bus, model  Must outlive this. @param clock  s, monotonic: when messages arrive. */
  PlayDaemon(Bus& bus, const RobotModel& model, const PlayOptions& options,
             std::function<double()> clock = monotonic_seconds);

  /** Registers message handling, steps and status with the loop. */
  void attach(EventLoop& loop);

  /** @param now  s, monotonic. */
  void step(double now);
  void publish_state();
  void publish_status(double now);
  /** Stops all that the program moves, when it ends. */
  void shut_down(double now);

  const PlayCore& core() const { return core_; }

 private:
  void subscribe();
  template <class Message>
  void watch_commands(const std::string& channel, CommandKind kind);
  void watch_teammates(const MatchState& state);
  /** Adds the command to play by itself, if one is due. */
  void request_auto(double now);

  Bus& bus_;
  const RobotModel& model_;
  std::function<double()> clock_;
  RobotChannels channels_;
  StatusReporter status_;
  CommandPublisher commands_;
  RobotViewer viewer_;
  std::string source_;
  PlayCore core_;
  TorsoHistory torso_;
  /** Input of the next step. */
  PlayInput input_;
  int64_t utime_ = 0;
  /** Monotonic times at which state and motion state were last received, s. */
  double last_robot_ = -1e9;
  double last_motion_ = -1e9;
  std::string robot_;
  Autonomy autonomy_;
  std::optional<MatchState> match_;
  std::map<std::string, TeamObservation> teammates_;
  /** Robots whose messages are received. */
  std::set<std::string> watched_;
  /** Monotonic time of the last match state, s. */
  double last_match_ = -1e9;
  std::string camera_;
};

}  // namespace nao::play
