#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemons/motion/commands/walk_overlay.h"
#include "daemons/motion/generators/motion_generator.h"
#include "daemons/motion/guards/joint_change_guard.h"
#include "daemons/motion/motion_factory.h"
#include "messages/command.h"
#include "messages/command_ledger.h"
#include "messages/mode.h"
#include "messages/reason.h"

namespace nao::motion {

/** A motion and the command that it executes; no command for the robot's own motions. */
struct Assignment {
  std::unique_ptr<MotionGenerator> generator;
  std::optional<Command> command;
  /** As in motion_state_t::command_name. */
  std::string name;
  /** Another motion had to end first: what was safe when the command came may not be safe now. */
  bool has_waited = false;
};

/** Decides which command runs, which one waits, and which ones are executed during a walk; answers
 * every command.
 *
 * The newest command wins: it waits until the running motion can be replaced, and replaces an older
 * one that waits. Three kinds of command need no motion of their own: a new velocity of a running
 * walk, a kick during a walk, and a change of head and arms during a walk (WalkOverlay).
 *
 * Every command gets kRefused, or kAccepted and later exactly one of kDone, kInterrupted and
 * kFailed. A repeated command gets its latest result again and is not executed again. */
class CommandArbiter {
 public:
  /** @param model, factory, guard  Must outlive this. */
  CommandArbiter(const RobotModel& model, MotionFactory& factory, JointChangeGuard& guard)
      : model_(&model), factory_(&factory), guard_(&guard) {}

  /** Answers a command and plans its motion. @param targets  As sent in the last step.
   * @param mode  Mode of the robot now. */
  void receive(const Command& command, const MotionContext& context, const JointTargets& targets,
               Mode mode);

  /** Makes a motion wait for the running one; it replaces another that waits. */
  void assign(Assignment assignment);

  /** Ends everything that runs, waits or overlays a walk as failed. */
  void abort_all(const Reason& reason);

  /** Starts a motion at once in place of the running one, which must have been aborted. */
  void start(Assignment assignment, const MotionContext& context, const JointTargets& targets);

  /** Starts a motion at once that goes on with the running one's command. */
  void hand_over(std::unique_ptr<MotionGenerator> generator, const MotionContext& context,
                 const JointTargets& targets);

  /** Starts the waiting motion if the running one can be replaced; otherwise asks that one to end.
   */
  void start_waiting(const MotionContext& context, const JointTargets& targets);

  /** A motion that ended in this step. */
  struct EndedMotion {
    MotionGenerator::Phase phase;
    Mode mode;
    /** It turned single joints and made none limp, so the body lies as before. */
    bool keeps_body = false;
  };

  /** One control step of the running motion and of the overlay.
   * @param targets  In: as sent in the last step. Out: as commanded by the motions.
   * @return The running motion, if it ended. */
  std::optional<EndedMotion> step(const MotionContext& context, JointTargets& targets);

  /** The running motion; nullptr if there is none. */
  const Assignment* running() const { return running_ ? &*running_ : nullptr; }
  /** True if no motion runs and none waits. */
  bool is_idle() const { return !running_ && !waiting_; }
  bool is_walking() const { return running_ && running_->generator->mode() == Mode::kWalking; }
  /** True while a change of head or arms is in progress. */
  bool has_overlay() const { return overlay_.command() != nullptr; }

  /** Results since the last call, in the order in which they were made. */
  std::vector<CommandResult> take_results() { return std::exchange(results_, {}); }
  /** Why the last refused command was refused; none if no command was refused. */
  const Reason& last_refusal() const { return last_refusal_; }

 private:
  /** find_fault(); taught motions are actions, too. */
  std::optional<Reason> find_value_fault(const Command& command) const;
  void repeat_result(const Command& command, const CommandResult& known);
  /** Passes a walk command to the walk that runs. A walk command without velocity starts no walk.
   * @return false if the command needs a motion of its own. */
  bool adopt_walk(const Command& command);
  /** Passes a kick to the walk that runs; a strong one must be done standing.
   * @return false if the command needs a motion of its own. */
  bool adopt_kick(const Command& command);
  /** Overlays the walk that runs with a change of head and arms.
   * @return false if the command needs a motion of its own. */
  bool overlay_walk(const Command& command, const MotionContext& context,
                    const JointTargets& targets);
  /** Why the motion that waits must not start now; nothing if it may. */
  std::optional<Reason> find_new_danger(const MotionContext& context, const JointTargets& targets);
  std::optional<EndedMotion> step_running(const MotionContext& context, JointTargets& targets);
  void watch_kick();
  void step_overlay(const MotionContext& context, const JointTargets& last, JointTargets& targets);
  void end_running(ResultStatus status, const Reason& reason);
  void end_waiting(ResultStatus status, const Reason& reason);
  void end_overlay(ResultStatus status, const Reason& reason);
  void answer(const Command& command, ResultStatus status, const Reason& reason = {});

  const RobotModel* model_;
  MotionFactory* factory_;
  JointChangeGuard* guard_;
  CommandLedger ledger_;
  std::vector<CommandResult> results_;
  Reason last_refusal_;
  std::optional<Assignment> running_;
  std::optional<Assignment> waiting_;
  /** A kick that the running walk executes. */
  std::optional<Command> walk_kick_;
  WalkOverlay overlay_;
};

}  // namespace nao::motion
