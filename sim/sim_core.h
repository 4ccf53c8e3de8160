#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/joint_command.h"
#include "sim/lola_robot.h"
#include "sim/rest_detector.h"
#include "sim/sim_lights.h"
#include "sim/sim_options.h"
#include "sim/tick_scheduler.h"
#include "sim/world.h"
#include "sim/world_command.h"

namespace nao::sim {

/** The simulator without bus and clock: a World, its commands, and the schedule of its ticks. Times
 * are arguments: s of a monotonic clock. */
class SimCore {
 public:
  /** Loads scene and robots. In a match, that is if robots have teams, the ball is at the center.
   * @throws ConfigError, ModelError */
  explicit SimCore(const SimOptions& options);
  /** A program requests images: in the next RestDetector::kRestDelay a world at rest sends a state
   * for each. */
  void take_image_request(double now) {
    if (!rest_.has_image_request(world_)) scheduler_.wake(now);
    rest_.note_image_request();
  }
  /** Starts the clock: the first tick is due one period from now. */
  void start(double now) { scheduler_.restart(now); }

  /** Options, with the teams from with_teams() and the present robots. */
  const SimOptions& options() const { return options_; }
  const World& world() const { return world_; }
  const TickScheduler& scheduler() const { return scheduler_; }
  /** @return Index; -1 if no robot has that name. The empty name means the first robot. */
  int find_robot(const std::string& name) const;
  /** Outcome of the last world command; id 0 if there was none. */
  const WorldCommandOutcome& last_world_command() const { return outcome_; }

  /** Sets a robot's targets. @return Nothing, or why the command is rejected: see
   * merge_joint_command(), or it answers a tick that is still to come. */
  [[nodiscard]] std::optional<std::string> take_joint_command(int robot,
                                                              const JointCommand& command,
                                                              double now);
  /** @return Nothing, or why a light command is refused. */
  [[nodiscard]] std::optional<Reason> take_light_command(int robot, const LightCommand& command) {
    return lights_[static_cast<size_t>(robot)].take(command);
  }
  /** Lights of a robot on the bus; with LoLA they are in lola(). */
  const SimLights& lights(int robot) const { return lights_[static_cast<size_t>(robot)]; }
  /** Nothing unless options().lola_socket is set. */
  const std::optional<LolaRobot>& lola() const { return lola_; }
  /** Takes a client's command as the answer to the newest tick: in lock-step the next one may be
   * run. */
  void take_lola_command(const LolaCommand& command, double now);
  /** Executes a world command; last_world_command() is its outcome.
   * @return false if the command was executed before: senders repeat them. */
  bool take_world_command(const WorldCommand& command, double now);

  /** Whether the next tick may be run, as far as pause and lock-step decide. */
  bool may_tick() const { return scheduler_.may_run(world_.tick()); }
  /** When to run the next tick, if it may be run; not after `now` means at once. */
  double next_tick(double now) const { return scheduler_.next_time(world_.tick(), now); }
  /** When to read commands: TickScheduler::next_reading(). */
  std::optional<double> next_reading(double now) const {
    return scheduler_.next_reading(world_.tick(), now);
  }
  /** Runs the next tick. @return Its delay behind its due time, s. */
  double run_tick(double now);
  /** Whether the last tick's state is sent: not in a world at rest (TickScheduler::rest()). */
  bool is_state_due() const { return is_state_due_; }

 private:
  /** A program acts: a world at rest runs what is due at once, and every tick from then on. */
  void wake(double now) {
    rest_.note_activity();
    scheduler_.wake(now);
  }
  /** After a tick: begins or ends the rest of the world. */
  void update_rest();
  /** @return Why a command is rejected; empty if it was executed. */
  std::string execute(const WorldCommand& command, double now);
  std::string step(const WorldCommand& command, double now);
  std::string reset(double now);
  std::string set_pace(const WorldCommand& command, double now);
  std::string place_robot(const WorldCommand& command);
  std::string place_ball(const WorldCommand& command);
  std::string push(const WorldCommand& command);
  std::string drag(const WorldCommand& command);
  std::string add_robot(const WorldCommand& command);
  std::string remove_robot(const WorldCommand& command);
  std::string touch(const WorldCommand& command);
  SimOptions options_;
  World world_;
  /** Robots that were ever in the world. */
  int num_drawn_robots_ = 0;
  TickScheduler scheduler_;
  RestDetector rest_;
  bool is_state_due_ = true;
  /** Targets of each robot that partial commands are merged into. */
  std::vector<MotorTargets> targets_;
  /** Senders and numbers of the last world commands. */
  std::deque<std::pair<std::string, int64_t>> executed_;
  WorldCommandOutcome outcome_;
  std::optional<LolaRobot> lola_;
  std::vector<SimLights> lights_;
};

}  // namespace nao::sim
