#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <naolcm/play_state_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/robot_option.h"
#include "common/second_process.h"
#include "common/status_reporter.h"
#include "common/wall_clock.h"
#include "daemons/referee/game_controller_listener.h"
#include "daemons/referee/referee_core.h"
#include "messages/command_ledger.h"
#include "messages/command_publisher.h"
#include "messages/match_command.h"

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::referee {

struct RefereeOptions {
  /** Robots, all with teams and numbers. */
  std::vector<RobotOption> robots;
  std::string scene = "soccer";
  Rules rules;
  /** Whether the match begins by itself when all robots are there. */
  bool starts_by_itself = false;
  /** The RoboCup GameController decides, at this UDP port; and the port at which it hears robots.
   */
  std::optional<uint16_t> game_controller_port{};
  uint16_t return_port = kGameControllerReturnPort;
  /** See GameControllerReferee. */
  std::optional<std::array<int, 2>> team_numbers{};
  /** Files in which the match is saved for another referee, and its events; empty: none. */
  std::filesystem::path state_file{};
  std::filesystem::path events_file{};
};

/** The simulated world as the referee sees it: ball and robots, without play states.
 * @param names  Robots that take part. */
RefereeInput to_input(const naolcm::world_truth_t& truth, const std::vector<MatchPlayer>& players);

/** What a robot knows from its own cameras. */
struct RobotKnowledge {
  /** Its pose, in its team's frame. */
  std::optional<Pose2> pose{};
  /** The ball as it was seen last, m, ahead of the robot and to its left, and its robot time, s. */
  std::optional<Eigen::Vector2d> ball{};
  double ball_time = 0;
};
void update(RobotKnowledge& knowledge, const naolcm::vision_state_t& vision);

/** Message of a robot to the GameController, without the team's number. @param now  Robot time, s.
 */
GameControllerReturn to_return(const MatchPlayer& player, const RobotSighting& robot,
                               const RobotKnowledge& knowledge, double now);

/** Connects a referee, our own or the GameController, to the bus: receives WORLD_TRUTH,
 * NAO_PLAY_STATE of every robot and MATCH_COMMAND, with a GameController also NAO_VISION_STATE for
 * what robots report; publishes MATCH_STATE, MATCH_COMMAND_RESULT and WORLD_COMMAND. */
class RefereeDaemon {
 public:
  /** Time between two match_state_t, s. */
  static constexpr double kStatePeriod = 0.2;

  /** @param bus  Must outlive this. @param clock  s, monotonic.
   * @throws ConfigError  if a robot has no team, a team no robot, or the scene no field.
   * @throws Error  if a file cannot be read or written. */
  RefereeDaemon(Bus& bus, const RefereeOptions& options,
                std::function<double()> clock = monotonic_seconds);

  /** Registers message handling and periods with the loop. */
  void attach(EventLoop& loop);

  void publish_state();
  /** Sends the world command that waits for its answer. */
  void send_placement();
  void publish_status(double now);

  const Referee& referee() const { return *referee_; }
  /** Port of the GameController's messages; 0 without. */
  uint16_t game_controller_port() const { return game_controller_ ? game_controller_->port() : 0; }
  /** Takes what the GameController has sent. */
  void receive_game_controller() { game_controller_->receive(); }
  /** Sends the robots' messages to it. */
  void answer_game_controller();

 private:
  struct Play {
    naolcm::play_state_t state;
    double received = -1e9;
  };

  void make_referee();
  void subscribe();
  void handle(const naolcm::world_truth_t& truth);
  void handle(const naolcm::match_command_t& message);
  void put(const Placement& placement);
  void write_files(const std::vector<MatchEvent>& events);
  /** @param fault  Why it was not written, as when the disk is full; empty: it was. */
  void note_file(const std::filesystem::path& file, const std::string& fault);

  Bus& bus_;
  RefereeOptions options_;
  std::function<double()> clock_;
  StatusReporter status_;
  SecondProcess second_process_;
  CommandPublisher commands_;
  std::map<std::string, std::string> ready_postures_;
  std::unique_ptr<Referee> referee_;
  /** Only with a GameController. */
  std::optional<GameControllerListener> game_controller_;
  std::map<std::string, RobotKnowledge> knowledge_;
  RefereeInput last_input_;
  std::map<std::string, Play> plays_;
  std::deque<naolcm::world_command_t> placements_;
  int64_t last_id_;
  CommandLedger ledger_;
  int64_t utime_ = 0;
  int64_t sequence_ = 0;
  /** Monotonic time of the last truth, s. */
  double last_truth_ = -1e9;
  /** Touches of the ball since the last step; contacts are shorter than steps. */
  std::map<std::string, bool> touches_;
  double next_step_ = 0;
  /** By file, for the status. */
  std::map<std::string, std::string> file_faults_;
  double last_saved_ = -1e9;
};

}  // namespace nao::referee
