#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <naolcm/play_state_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>
#include <vector>

#include "common/robot_option.h"
#include "common/status_reporter.h"
#include "common/wall_clock.h"
#include "daemons/referee/referee_core.h"
#include "messages/command_ledger.h"
#include "messages/match_command.h"

namespace nao {
class Bus;
class EventLoop;
}  // namespace nao

namespace nao::referee {

struct RefereeOptions {
  /** All with teams and numbers. */
  std::vector<RobotOption> robots;
  std::string scene = "soccer";
  Rules rules;
  /** Begins the match by itself when all robots are there. */
  bool starts_by_itself = false;
  /** Where the match is kept for another referee, and its events; empty: nowhere. */
  std::filesystem::path state_file{};
  std::filesystem::path events_file{};
};

/** What the referee sees of the simulated world: ball and robots, without play states.
 * @param names  Robots that take part. */
RefereeInput to_input(const naolcm::world_truth_t& truth, const std::vector<MatchPlayer>& players);

/** Connects RefereeCore to the bus: receives WORLD_TRUTH, NAO_PLAY_STATE of every robot and
 * MATCH_COMMAND; publishes MATCH_STATE, MATCH_COMMAND_RESULT and WORLD_COMMAND. */
class RefereeDaemon {
 public:
  /** s between two match_state_t, and between two transmissions of a world command. */
  static constexpr double kStatePeriod = 0.2;
  static constexpr double kRepeatPeriod = 0.1;

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

  const RefereeCore& core() const { return core_; }

 private:
  struct Play {
    naolcm::play_state_t state;
    double received = -1e9;
  };

  void subscribe();
  void handle(const naolcm::world_truth_t& truth);
  void handle(const naolcm::match_command_t& message);
  void put(const Placement& placement);
  void write_files(const std::vector<MatchEvent>& events);

  Bus& bus_;
  RefereeOptions options_;
  std::function<double()> clock_;
  StatusReporter status_;
  std::map<std::string, std::string> ready_postures_;
  RefereeCore core_;
  std::map<std::string, Play> plays_;
  std::deque<naolcm::world_command_t> placements_;
  std::string source_;
  int64_t last_id_;
  CommandLedger ledger_;
  int64_t utime_ = 0;
  int64_t sequence_ = 0;
  /** s, monotonic: of the last truth. */
  double last_truth_ = -1e9;
  /** Touches of the ball since the last step: a contact is short. */
  std::map<std::string, bool> touches_;
  double next_step_ = 0;
  double last_saved_ = -1e9;
};

}  // namespace nao::referee
