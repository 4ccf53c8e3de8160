#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/motion_core.h"
#include "robot_model/robot_model.h"
#include "robot_model/scene_file.h"
#include "sim/world.h"

namespace nao {

/** What all trials share. */
struct ClosedLoopOptions {
  std::shared_ptr<const RobotModel> model;
  SceneFile scene;
  /** No randomisation, noise or latency. */
  bool is_ideal = false;
  /** Chance in each tick that the mind misses it and up to three more, as under a busy operating
   * system: the servos hold their targets, and the mind goes on with the newest sensors. */
  double late_share = 0;
  /** Ticks between a joint command and the motors' following it, as over a slow network; 0: 1 or 2
   * by chance. */
  int command_latency_ticks = 0;
  /** Posture that the robot starts in. */
  std::string posture = "StandInit";
  motion::MotionOptions motion;
};

/** One simulated robot with the motion core as its mind, in lock-step, without a bus.
 *
 * The seed decides everything that is random: floor friction 0.5 to 1.0, mass +-3 %, command
 * latency 1 or 2 ticks, sensor noise and bias. The same seed on the same build gives the same bits.
 */
class ClosedLoop {
 public:
  ClosedLoop(const ClosedLoopOptions& options, uint64_t seed);

  const RobotModel& model() const { return *options_.model; }
  sim::World& world() { return world_; }
  const motion::MotionCore& core() const { return *core_; }
  /** A new mind for the same body, as after a crash of nao-motion. */
  void restart_core();
  /** While true the mind is dead: the servos hold their last targets. */
  void set_core_dead(bool is_dead) { is_dead_ = is_dead; }
  /** Uniform in [low, high), from the trial's own seed. */
  double random(double low, double high);

  /** Queues a command for the next tick. @return Its number. */
  int64_t send(Command command);
  int64_t send_posture(const std::string& posture, double speed);
  int64_t send_action(const std::string& action);
  /** Wishes to walk: sends the velocity now and five times a second, as a thumb on a joystick does,
   * as one command until release_walk(). @param velocity  m/s ahead and to the left, rad/s. @return
   * The command's number. */
  int64_t hold_walk(const Eigen::Vector3d& velocity);
  /** Says no more about walking. @param says_so  Sends a last command with no velocity. */
  void release_walk(bool says_so = true);

  /** One tick of world and core. */
  void step();
  /** Steps for so many s. */
  void run(double duration);
  /** Steps until the command has ended. @return Its end, or nothing after `timeout` s. */
  std::optional<CommandResult> await_end(int64_t id, double timeout);
  /** Steps until the condition holds. @return false after `timeout` s. */
  bool run_until(const std::function<bool()>& condition, double timeout);

  /** All results so far. */
  const std::vector<CommandResult>& results() const { return results_; }
  /** Last targets of the core. */
  const std::vector<double>& targets() const { return targets_; }
  /** What the core last made of its sensors. */
  const motion::RobotState& estimate() const { return estimate_; }
  /** Called after every tick. */
  void on_tick(std::function<void()> handler) { on_tick_ = std::move(handler); }

  /** Adds the time of each later step of the core to a list. @param clock  s. */
  void measure_steps(double (*clock)(), std::vector<double>& times) {
    clock_ = clock;
    step_times_ = &times;
  }

  // What is true.
  /** s since the start. */
  double time() const { return world_.time(); }
  Eigen::Isometry3d torso_in_world() const;
  double torso_height() const { return torso_in_world().translation().z(); }
  /** Angle between the torso's z axis and up, rad. */
  double torso_tilt() const;
  /** Greatest deviation of the true joint angles from a posture, rad, hands left out. */
  double deviation_from(const Posture& posture, std::string* joint = nullptr) const;

 private:
  ClosedLoopOptions options_;
  sim::World world_;
  std::unique_ptr<motion::MotionCore> core_;
  uint64_t random_state_;
  bool is_dead_ = false;
  std::vector<Command> commands_;
  std::optional<Command> walk_;
  int ticks_since_walk_ = 0;
  int ticks_to_miss_ = 0;
  int missed_ticks_ = 0;
  int64_t last_id_ = 0;
  std::vector<CommandResult> results_;
  std::vector<double> targets_;
  motion::RobotState estimate_;
  std::function<void()> on_tick_;
  double (*clock_)() = nullptr;
  std::vector<double>* step_times_ = nullptr;
};

}  // namespace nao
