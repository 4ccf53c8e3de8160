#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/random.h"
#include "daemons/motion/motion_core.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "sim/disturbances.h"
#include "sim/world.h"

namespace nao {

/** Options of a closed loop. */
struct ClosedLoopOptions {
  std::shared_ptr<const RobotModel> model;
  SceneFile scene;
  /** Physics engine, see sim::WorldOptions::engine. */
  std::string engine = "fast";
  /** Disturbances that are drawn for each seed; nullptr: data/disturbances/default.yaml. */
  std::shared_ptr<const sim::DisturbanceSet> disturbances;
  /** Without disturbances, noise and latency; `disturbances` is ignored. */
  bool is_ideal = false;
  /** Probability in each tick that the motion core misses it and up to three more, as on a busy
   * machine: the servos hold their targets, and the core continues with the newest sensor readings.
   */
  double missed_tick_probability = 0;
  /** Ticks until the motors follow a joint command, as over a slow network; 0: as the disturbances
   * say. */
  int command_latency_ticks = 0;
  /** Control period, ms: a multiple of the physics step of 2 ms. 0: as the disturbances say, or 10.
   */
  int tick_ms = 0;
  /** Posture that the robot starts in; empty: its ready posture. */
  std::string posture{};
  motion::MotionOptions motion;
};

/** One simulated robot and the motion core that controls it, in lock-step in one process, without a
 * bus.
 *
 * The seed determines everything random: disturbances, sensor noise and bias. The same seed on the
 * same build gives the same bits.
 *
 * It has more than 25 methods: it is the interface of all trials, tuners and physics tests. */
class ClosedLoop {
 public:
  /** @throws ConfigError  if an option is outside its range. */
  ClosedLoop(const ClosedLoopOptions& options, uint64_t seed);
  /** One more robot of a world that several share: call the world's step_tick(), then step_core()
   * of each. @param world  World from make_world(). */
  ClosedLoop(const ClosedLoopOptions& options, uint64_t seed, std::shared_ptr<sim::World> world);
  /** A world without robots, disturbed as the options say. */
  static std::shared_ptr<sim::World> make_world(const ClosedLoopOptions& options, uint64_t seed);

  const RobotModel& model() const { return *options_.model; }
  sim::World& world() { return *world_; }
  /** Index of the robot in the world. */
  int robot() const { return robot_; }
  const motion::MotionCore& core() const { return *core_; }
  /** Replaces the motion core by a new one, as when nao-motion is restarted. */
  void restart_core();
  /** While true the motion core is not stepped, as after a crash of nao-motion: the servos hold
   * their last targets. */
  void set_core_crashed(bool is_crashed) { is_core_crashed_ = is_crashed; }
  /** Uniform in [low, high), by the seed. */
  double random(double low, double high) { return random_.uniform(low, high); }
  /** Control period, s. */
  double period() const { return world_->options().period(); }

  /** Queues a command for the next tick. @return Its number. */
  int64_t send(Command command);
  /** Queues a command with its own sender and number for the next tick. */
  void pass_on(Command command) { commands_.push_back(std::move(command)); }
  int64_t send_posture(const std::string& posture, double speed);
  int64_t send_action(const std::string& action);
  /** Makes a taught motion an action from the next tick on. */
  void teach(motion::ActionScript script);
  /** Commands a velocity now and every 0.2 s, as an operator's joystick does, as one command until
   * release_walk(). @param velocity  m/s ahead and to the left, rad/s. @return The command's
   * number.
   */
  int64_t hold_walk(const Eigen::Vector3d& velocity);
  /** Ends hold_walk(). @param sends_stop  Send a last command with velocity 0. */
  void release_walk(bool sends_stop = true);

  /** One tick of world and core. */
  void step();
  /** One tick of the core, after one of the world. */
  void step_core();
  /** Steps for a duration, s. */
  void run(double duration);
  /** Steps until the command has ended. @return Its final result, or nothing after `timeout` s. */
  std::optional<CommandResult> await_end(int64_t id, double timeout);
  /** Steps until the condition holds. @return false after `timeout` s. */
  bool run_until(const std::function<bool()>& condition, double timeout);

  /** The results since the start or take_results(). For a walk that hold_walk() repeats, each
   * status is listed once while it lasts, although the core answers every repetition. */
  const std::vector<CommandResult>& results() const { return results_; }
  /** Returns the same results and clears them. */
  std::vector<CommandResult> take_results() { return std::exchange(results_, {}); }
  /** The ball that the core knows from the next tick on; nothing: none. */
  void set_ball(const std::optional<motion::SeenBall>& ball) { ball_ = ball; }
  /** Called with what the core receives of the sensors, in every tick from the next one on: a
   * fault. */
  void on_sensors(std::function<void(motion::Sensors&)> fault) { fault_ = std::move(fault); }
  /** Last targets of the core. */
  const std::vector<double>& targets() const { return targets_; }
  /** State as the core estimated it last. */
  const motion::RobotState& estimate() const { return estimate_; }
  /** Called after every tick. */
  void on_tick(std::function<void()> handler) { on_tick_ = std::move(handler); }

  /** Adds the time of each later step of the core to a list. @param clock  s. */
  void measure_steps(double (*clock)(), std::vector<double>& times) {
    clock_ = clock;
    step_times_ = &times;
  }

  // The true state.
  /** Time since the start, s. */
  double time() const { return world_->time(); }
  Eigen::Isometry3d torso_in_world() const;
  double torso_height() const { return torso_in_world().translation().z(); }
  /** Angle between the torso's z axis and up, rad. */
  double torso_tilt() const;
  /** Largest deviation of the true joint angles from a posture, rad, without the openings of hands.
   * @param joint  Receives the name of that joint. */
  double deviation_from(const Posture& posture, std::string* joint = nullptr) const;

 private:
  int ticks_per_walk_command() const;
  void keep(const std::vector<CommandResult>& results);

  ClosedLoopOptions options_;
  std::shared_ptr<sim::World> world_;
  int robot_ = 0;
  std::unique_ptr<motion::MotionCore> core_;
  Random random_;
  bool is_core_crashed_ = false;
  std::vector<Command> commands_;
  std::vector<motion::TaughtChange> taught_;
  std::optional<motion::SeenBall> ball_;
  std::optional<Command> walk_;
  int ticks_since_walk_ = 0;
  int ticks_to_miss_ = 0;
  int missed_ticks_ = 0;
  int64_t last_id_ = 0;
  std::vector<CommandResult> results_;
  /** Number and status of the last result of a walk. */
  std::pair<int64_t, ResultStatus> last_walk_result_{0, ResultStatus::kAccepted};
  std::vector<double> targets_;
  motion::RobotState estimate_;
  std::function<void(motion::Sensors&)> fault_;
  std::function<void()> on_tick_;
  double (*clock_)() = nullptr;
  std::vector<double>* step_times_ = nullptr;
};

}  // namespace nao
