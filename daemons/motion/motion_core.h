#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/commands/command_arbiter.h"
#include "daemons/motion/estimator/dead_foot_sensors.h"
#include "daemons/motion/estimator/state_estimator.h"
#include "daemons/motion/falls/fall_supervisor.h"
#include "daemons/motion/guards/joint_change_guard.h"
#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/guards/servo_gains.h"
#include "daemons/motion/joint_targets.h"
#include "daemons/motion/motion_factory.h"
#include "daemons/motion/motion_options.h"
#include "daemons/motion/motion_state.h"
#include "daemons/motion/robot_presence.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/seen_ball.h"
#include "daemons/motion/sensor_correction.h"
#include "daemons/motion/sensors.h"
#include "daemons/motion/standing_balance.h"
#include "daemons/motion/state_reporter.h"
#include "messages/command.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** A taught motion that can be played from now on, by its name; nullptr: it cannot any longer. */
struct TaughtChange {
  std::string name;
  std::shared_ptr<const ActionScript> script;
};

/** Input of one control step. */
struct Input {
  /** Nothing while no sensor data arrive. */
  std::optional<Sensors> sensors;
  /** In the order in which they arrived. */
  std::vector<Command> commands;
  std::vector<TaughtChange> taught{};
  /** Nothing while nao-vision knows none; one that was seen long ago tells nothing. */
  std::optional<SeenBall> ball{};
};

/** Output of one control step. */
struct Output {
  /** Present exactly if there were sensor data: the answer to them, and the estimate. */
  std::optional<JointTargets> joint_targets;
  std::optional<RobotState> robot_state;
  /** Present when it is due: at each change, and ten times a second. */
  std::optional<MotionState> motion_state;
  /** In the order in which they were made. */
  std::vector<CommandResult> results;
  /** Present if a policy made a step. */
  std::optional<PolicyRecord> policy;
};

/** Computes joint targets from sensors and commands: takes over a robot, keeps it on its feet,
 * executes commands one after the other, and answers them.
 *
 * No clock, thread, file, socket or log: the same inputs give the same outputs, bit for bit. The
 * control period is what the caller passes as `dt`, and may change from step to step.
 *
 * Before the first command it takes the robot over without a jump: the targets continue from what
 * the servos hold. A standing robot then goes to StandInit, unless it is in a known posture
 * already. A robot that has fallen, or lies in no known posture when it is taken over, gets up by
 * itself. A relaxed robot stays relaxed until a command wakes it up. */
class MotionCore {
 public:
  /** @param model  Must outlive this.
   * @throws ConfigError  if an option is out of its range; ModelError  if a file of the robot is
   * wrong or it has no posture StandInit. */
  MotionCore(const RobotModel& model, const MotionOptions& options);

  // The parts refer to each other.
  MotionCore(const MotionCore&) = delete;
  MotionCore& operator=(const MotionCore&) = delete;

  /** One control step.
   * @param dt  Robot time since the last step, s, above 0; while no sensor data arrive, time of any
   *   clock. */
  Output step(const Input& input, double dt);

  const MotionState& motion_state() const { return reporter_.state(); }
  const RobotModel& model() const { return *model_; }
  const std::vector<Policy>& policies() const { return factory_.policies(); }

 private:
  void take_sensors(const Sensors& sensors, double dt);
  void wait_for_sensors(double dt);
  /** @param is_placed  It is the robot of before, placed elsewhere. */
  void take_over(bool is_placed);
  void receive(const std::vector<Command>& commands);
  void move(double dt);
  void choose_first_motion(double dt);
  void handle_falls(double dt);
  /** Begins to step if a robot that only stands was pushed so that it cannot come to rest in place.
   */
  void handle_push();
  void run_motions(double dt);
  /** Targets of limp joints follow their angles, so that a limb that is moved by hand stays where
   * it is when it becomes stiff. */
  void follow_limp_joints();
  void limit_targets(const JointTargets& last, double dt);
  /** Targets for the servos: those of the motions, or of the balance of a robot that only stands.
   */
  void balance(double dt);

  MotionContext context(double dt) const;
  Mode mode() const;
  /** True if no motor has stiffness. */
  bool is_relaxed() const;

  const RobotModel* model_;
  MotionOptions options_;
  /** Nothing without a calibration. */
  std::optional<SensorCorrection> correction_;
  DeadFootSensors dead_foot_sensors_;
  /** Sensors of this step. */
  Sensors corrected_;
  std::optional<SeenBall> ball_;
  RobotPresence presence_;
  StateEstimator estimator_;
  JointChangeGuard guard_;
  MotionFactory factory_;
  CommandArbiter arbiter_;
  FallSupervisor falls_;
  TargetLimiter limiter_;
  ServoGains gains_;
  StateReporter reporter_;
  std::optional<StandingBalance> standing_;
  /** Targets of the motions in the last step. */
  JointTargets targets_;
  /** Positions that were sent in the last step. */
  std::vector<double> sent_;
  /** Time since the robot was taken over, s; the first motion is chosen when the estimate has
   * settled. */
  double time_with_robot_ = 0;
  bool has_first_motion_ = false;
};

}  // namespace nao::motion
