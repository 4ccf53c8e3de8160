#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "daemons/motion/actions/action_script.h"
#include "daemons/motion/actions/kick.h"
#include "daemons/motion/commands/command_ledger.h"
#include "daemons/motion/estimator/state_estimator.h"
#include "daemons/motion/falls/fall_monitor.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/guards/self_collision_guard.h"
#include "daemons/motion/guards/tipping_guard.h"
#include "daemons/motion/joint_targets.h"
#include "daemons/motion/motion_options.h"
#include "daemons/motion/motion_state.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/sensors.h"
#include "daemons/motion/transitions/transition_graph.h"
#include "daemons/motion/walk/gait.h"
#include "messages/command.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** What reaches the core in one step. */
struct Input {
  /** Nothing while the robot is silent. */
  std::optional<Sensors> sensors;
  /** In the order in which they came. */
  std::vector<Command> commands;
};

/** What the core answers with. */
struct Output {
  /** Present exactly if there were sensors: the answer to this tick, and what was estimated. */
  std::optional<JointTargets> joint_targets;
  std::optional<RobotState> robot_state;
  /** Present when it is due: at each change, and ten times a second. */
  std::optional<MotionState> motion_state;
  /** In the order in which they came about. */
  std::vector<CommandResult> results;
};

/** Everything that decides where the joints go: takes over a robot wherever its joints are, keeps
 * it standing, carries out commands one after the other, and says what became of them.
 *
 * No clock, thread, file, socket or log: the same inputs give the same outputs, bit for bit.
 *
 * Before the first command it takes the robot over without a jump (targets go on from what the
 * servos hold) and brings a standing robot to StandInit, unless it is in a known posture already. A
 * robot that has fallen, or lies in no known posture when it is taken over, gets up by itself. A
 * limp one stays limp until a command wakes it. */
class MotionCore {
 public:
  /** @param model  Must outlive this.
   * @throws ConfigError  if the options make no sense; ModelError  if the robot has no StandInit.
   */
  MotionCore(const RobotModel& model, const MotionOptions& options);

  /** One control step.
   * @param dt  Robot time since the last step, s, above 0; while the robot is silent any clock's.
   */
  Output step(const Input& input, double dt);

  const MotionState& motion_state() const { return state_; }
  const RobotModel& model() const { return *model_; }

 private:
  /** A motion and the command that asked for it; nobody's for what the core does by itself. */
  struct Assignment {
    std::unique_ptr<MotionGenerator> generator;
    std::optional<Command> command;
    std::string detail;
    /** Its turn did not come at once: what was safe when it came may not be so now. */
    bool has_waited = false;
  };

  /** Joints of head and arms that turn, or have turned, while the robot walks on. */
  struct Overlay {
    std::unique_ptr<MotionGenerator> generator;
    Command command;
    std::vector<int> motors;
  };

  /** A motion that carries out a command, or why there is none. */
  using Plan = std::variant<std::unique_ptr<MotionGenerator>, Reason>;

  void take_sensors(const Sensors& sensors, double dt);
  void lose_robot();
  /** @param is_placed  Somebody has put the robot that it had elsewhere. */
  void take_over(const Sensors& sensors, bool is_placed);
  void choose_first_motion();

  void receive(const Command& command);
  /** A walk's new velocity goes to the walk that runs already; one that asks for no velocity starts
   * none. @return false if the command needs a motion of its own. */
  bool adopt_walk(const Command& command);
  /** A kick out of the walk goes to the walk that runs; a strong one must stand.
   * @return false if the command needs a motion of its own. */
  bool adopt_kick(const Command& command);
  void watch_kick();
  /** A change of head and arms turns them while the legs walk on.
   * @return false if the command needs a motion of its own. */
  bool overlay_walk(const Command& command);
  bool is_walking() const;
  std::optional<Reason> refuse_walk() const;
  /** The same for a walk that goes to its stand first, which it may do from a seat. */
  std::optional<Reason> refuse_walk_after_standing_up() const;
  Plan plan_kick(bool is_left, const ActionCommand& action);
  Plan plan_script(const ActionScript& script);
  /** The way to the stand that walks begin in. */
  std::unique_ptr<MotionGenerator> plan_stand() const;
  Plan plan(const Command& command);
  Plan plan_request(const WalkCommand& walk);
  Plan plan_request(const MoveToCommand& move_to);
  Plan plan_request(const PostureCommand& posture);
  Plan plan_request(const JointChangeCommand& change);
  Plan plan_request(const ActionCommand& action);
  Plan plan_request(const StopCommand& stop);
  /** Why a joint change would end badly; nothing if it would not. */
  std::optional<Reason> find_danger(const JointChangeCommand& change);
  /** @param start  What the change would go on from. */
  std::optional<Reason> find_self_collision(const JointChangeCommand& change,
                                            const JointTargets& start);
  std::optional<Reason> find_tipping(const JointChangeCommand& change);
  void assign(Assignment assignment);

  void move(double dt);
  void watch_for_falls(double dt);
  bool means_to_stand() const;
  void start_waiting();
  /** What speaks against beginning `assignment` now, though nothing did when it came;
   * nothing if nothing does. */
  std::optional<Reason> find_new_danger(const Assignment& assignment);
  void end_running(ResultStatus status, const Reason& reason);
  /** Writes the overlaid joints over what the walk wants of them. @param last  Targets of the last
   * tick. */
  void step_overlay(double dt, const JointTargets& last);
  void end_overlay(ResultStatus status, const Reason& reason);
  void answer(const Command& command, ResultStatus status, const Reason& reason,
              bool is_remembered = true);

  MotionContext context(double dt) const;
  Mode current_mode() const;
  bool is_lying() const;
  bool is_limp() const;
  bool sits() const;
  void report(double dt);

  const RobotModel* model_;
  MotionOptions options_;
  std::optional<Gait> gait_;
  std::optional<Kick> kick_;
  std::vector<ActionScript> scripts_;
  TargetLimiter limiter_;
  TransitionGraph graph_;
  StateEstimator estimator_;
  TippingGuard tipping_guard_;
  SelfCollisionGuard collision_guard_;
  FallMonitor fall_monitor_;
  CommandLedger ledger_;

  bool has_robot_ = false;
  double silence_ = 0;
  /** s since the robot was taken over; the first motion is chosen a moment later. */
  double time_with_robot_ = 0;
  bool has_first_motion_ = false;
  Sensors sensors_;

  JointTargets targets_;
  /** Lies where it did not mean to; s since it lies still. */
  bool has_fallen_ = false;
  double time_fallen_ = 0;
  bool was_lying_ = false;
  /** Could not get up, and tries no more by itself until somebody helps or commands. */
  bool needs_help_ = false;
  std::optional<Assignment> running_;
  std::optional<Assignment> waiting_;
  /** A kick that the running walk strikes in passing. */
  std::optional<Command> walk_kick_;
  std::optional<Overlay> overlay_;
  /** Motors that changes during this walk have turned, and where they stay until it ends, rad. */
  std::map<int, double> overlaid_;

  MotionState state_;
  Reason last_refusal_;
  double since_motion_state_ = 0;
  Output output_;
};

}  // namespace nao::motion
