#pragma once

#include <deque>
#include <memory>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/event_loop.h"
#include "common/rate_limiter.h"
#include "common/status_reporter.h"
#include "sim/answer_delay.h"
#include "sim/pacer.h"
#include "sim/sim_options.h"
#include "sim/world.h"

namespace nao::sim {

/** Puts a World on the bus: takes joint commands and world commands, steps the world in time with
 * the wall clock or in lock-step, publishes what robots sense and what is true. */
class SimDaemon {
 public:
  /** Loads scene and robot and publishes tick 0. Bus and loop must outlive this.
   * @throws ConfigError, ModelError */
  SimDaemon(Bus& bus, EventLoop& loop, const SimOptions& options);
  ~SimDaemon();
  SimDaemon(const SimDaemon&) = delete;
  SimDaemon& operator=(const SimDaemon&) = delete;

  const World& world() const { return *world_; }
  int64_t num_late_ticks() const { return num_late_ticks_; }
  int64_t num_late_commands() const { return num_late_commands_; }

 private:
  struct Port {
    RobotChannels channels;
    MotorTargets targets;
    /** Newest tick that a command has answered, and when it came (monotonic s). */
    int64_t answered_tick = -1;
    double answer_time = -1e9;
    bool has_answered = false;
    AnswerDelay answer_delay{};
  };

  void take_joint_command(int robot, const naolcm::joint_command_t& message);
  void take_world_command(const naolcm::world_command_t& message);
  /** @return What is wrong with the command; empty if it was carried out. */
  std::string carry_out(const naolcm::world_command_t& message);
  std::string place_robot(const naolcm::world_command_t& message, int robot);
  std::string push(const naolcm::world_command_t& message, int robot);
  int find_robot(const std::string& name) const;

  /** Runs the ticks that are due and sets the alarm for the next. */
  void run_due_ticks();
  bool may_tick() const;
  /** Wall time of the next tick: when it is due, or a moment later while an answer is on its way.
   */
  double next_tick(double now) const;
  void run_tick(double now);
  void set_alarm(double now);
  void repeat_while_waiting();
  void publish_sensors();
  void publish_truth();
  void publish_status();
  std::string surface_name(const Surface& surface) const;

  Bus& bus_;
  EventLoop& loop_;
  SimOptions options_;
  std::shared_ptr<const RobotModel> model_;
  std::unique_ptr<World> world_;
  std::vector<Port> ports_;
  std::vector<std::string> joint_names_;
  std::vector<std::string> foot_sensor_names_;
  StatusReporter status_;
  Pacer pacer_;
  int alarm_;
  bool is_paused_ = false;
  int64_t ticks_to_step_ = 0;

  int64_t num_late_ticks_ = 0;
  int64_t num_late_commands_ = 0;
  int64_t num_bad_states_ = 0;
  RateLimiter warnings_{1.0};
  /** Lateness of the ticks since the last status, s. */
  std::vector<double> lateness_;
  double tick_seconds_ = 0;
  double rate_time_ = 0;
  int64_t rate_ticks_ = 0;
  int64_t ticks_run_ = 0;
  double real_time_factor_ = 0;
  double last_publish_time_ = 0;
  double last_tick_time_ = 0;

  std::deque<std::pair<std::string, int64_t>> done_commands_;
  std::string last_command_source_;
  int64_t last_command_id_ = 0;
  std::string last_command_error_;
};

}  // namespace nao::sim
