#pragma once

#include <cstdint>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/light_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/rate_limiter.h"
#include "common/second_process.h"
#include "common/status_reporter.h"
#include "sim/lola_server.h"
#include "sim/sim_core.h"
#include "sim/sim_options.h"
#include "sim/tick_statistics.h"

namespace nao::sim {

/** Connects a SimCore to bus and clock: decodes commands, runs the ticks that are due, publishes
 * what robots sense and what is true.
 *
 * With SimOptions::lola_socket the robot is connected to that socket and not to the bus; only the
 * world is on the bus. */
class SimDaemon {
 public:
  /** Loads scene and robots and publishes tick 0. Bus and loop must outlive this.
   * @throws ConfigError, ModelError, Error */
  SimDaemon(Bus& bus, EventLoop& loop, const SimOptions& options);
  ~SimDaemon();
  SimDaemon(const SimDaemon&) = delete;
  SimDaemon& operator=(const SimDaemon&) = delete;

  const SimCore& core() const { return core_; }

 private:
  void subscribe_world();
  /** Updates channels after robots were added or removed. */
  void update_robots();
  void serve_lola();
  /** Passes a command to the robot of this name, which may have been removed. */
  void take_joint_command(const std::string& robot, const naolcm::joint_command_t& message);
  void take_light_command(const std::string& robot, const naolcm::light_command_t& message);
  void take_world_command(const naolcm::world_command_t& message);
  /** Runs the ticks that are due and sets the timer for the next. */
  void run_due_ticks();
  void run_tick(double now);
  void set_timer(double now);
  void repeat_while_waiting();
  void warn_of_failures(double now);
  void publish_sensors();
  void publish_truth();
  void publish_bodies();
  void publish_status();
  /** What the world waits for, or "paused"; empty if it runs. @param num_ticks  Since the last
   * call. */
  std::string status_detail(int64_t num_ticks) const;

  Bus& bus_;
  EventLoop& loop_;
  SimCore core_;
  std::optional<LolaServer> lola_;
  std::vector<RobotChannels> channels_;
  /** Robots whose commands arrive: LCM's subscriptions last as long as the bus. */
  std::set<std::string> subscribed_;
  StatusReporter status_;
  SecondProcess second_process_;
  TickStatistics statistics_;
  double real_time_factor_ = 0;
  /** Descriptor of the timer of the next tick. */
  int timer_ = -1;
  /** Timer that calls repeat_while_waiting(). */
  int idle_timer_ = -1;
  double last_publish_time_ = 0;
  int64_t num_bad_states_ = 0;
  int64_t num_dropped_contacts_ = 0;
  RateLimiter rejection_warnings_{1.0};
  RateLimiter bad_state_warnings_{1.0};
  RateLimiter dropped_contact_warnings_{1.0};
};

}  // namespace nao::sim
