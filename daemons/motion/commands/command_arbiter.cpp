#include "daemons/motion/commands/command_arbiter.h"

#include <algorithm>

#include "daemons/motion/commands/acceptance.h"
#include "daemons/motion/commands/command_check.h"
#include "daemons/motion/standing_rates.h"

namespace nao::motion {
namespace {

using Phase = MotionGenerator::Phase;

// Greatest strength of a kick that is done during the walk; for a stronger one the robot stops and
// kicks standing. Chosen: the middle of the range (0, 1].
constexpr double kMaxWalkKickStrength = 0.5;

bool executes(const std::optional<Assignment>& assignment, const Command& command) {
  return assignment && assignment->command && assignment->command->source == command.source &&
         assignment->command->id == command.id;
}

/** A change of single joints that makes none limp: no person is about to move the robot. */
bool keeps_body(const Command& command) {
  const auto* change = std::get_if<JointChangeCommand>(&command.request);
  return change != nullptr &&
         std::none_of(change->joint_stiffness.begin(), change->joint_stiffness.end(),
                      [](double stiffness) { return stiffness == 0; });
}

/** Reason with which a newer motion interrupts a command. */
Reason replaced_by(const Assignment& newer) {
  return newer.command ? Reason("replaced", {newer.name})
                       : Reason("replaced-by-motion", {newer.name});
}

}  // namespace

// Checks in this order: sender, repetition, the command itself, the robot's mode, and what the
// motion itself finds. Each command gets exactly one answer here, accepted or refused, and if
// accepted a final one later.
void CommandArbiter::receive(const Command& command, const MotionContext& context,
                             const JointTargets& targets, Mode mode) {
  if (const auto fault = check_sender(command.source, command.id)) {
    // Not remembered: source and number do not identify the command.
    last_refusal_ = *fault;
    results_.push_back(
        {command.source, command.id, kind_of(command), ResultStatus::kRefused, *fault});
    return;
  }
  // A sender repeats a command until it is answered: the second time it must not act again.
  if (const CommandResult* known = ledger_.find(command.source, command.id)) {
    repeat_result(command, *known);
    return;
  }
  if (const auto fault = find_value_fault(command)) {
    answer(command, ResultStatus::kRefused, *fault);
    return;
  }
  if (const auto obstacle = find_mode_obstacle(kind_of(command), mode)) {
    answer(command, ResultStatus::kRefused, *obstacle);
    return;
  }
  // Commands that the running motion can adopt need no new motion.
  if (adopt_walk(command) || adopt_kick(command) || overlay_walk(command, context, targets)) {
    return;
  }
  MotionPlan plan = factory_->plan(command, context, targets);
  if (const auto* refusal = std::get_if<Reason>(&plan)) {
    answer(command, ResultStatus::kRefused, *refusal);
    return;
  }
  answer(command, ResultStatus::kAccepted);
  assign({std::move(std::get<std::unique_ptr<MotionGenerator>>(plan)), command, describe(command)});
}

std::optional<Reason> CommandArbiter::find_value_fault(const Command& command) const {
  auto fault = find_fault(*model_, command);
  const auto* action = std::get_if<ActionCommand>(&command.request);
  const bool is_taught = action != nullptr && fault && fault->code == "action-unknown" &&
                         factory_->has_taught(action->action);
  return is_taught ? std::nullopt : fault;
}

void CommandArbiter::repeat_result(const Command& command, const CommandResult& known) {
  // A walk is repeated with new velocities as long as the operator holds the joystick.
  if (!find_value_fault(command)) {
    if (executes(running_, command)) running_->generator->adopt(command);
    if (executes(waiting_, command)) waiting_->generator->adopt(command);
  }
  results_.push_back(known);
}

// A new walk command changes the velocity of the walk that runs, without a stop in between.
bool CommandArbiter::adopt_walk(const Command& command) {
  const auto* walk = std::get_if<WalkCommand>(&command.request);
  if (walk == nullptr || waiting_) return false;
  // A walk at velocity zero does nothing unless the robot walks: a standing robot has already
  // fulfilled it.
  const bool runs_walk =
      running_ && running_->command && kind_of(*running_->command) == CommandKind::kWalk;
  if (!runs_walk) {
    if (walk->vx != 0 || walk->vy != 0 || walk->wz != 0) return false;
    answer(command, ResultStatus::kAccepted);
    answer(command, ResultStatus::kDone, {"not-walking"});
    return true;
  }
  if (!running_->generator->adopt(command)) return false;
  answer(*running_->command, ResultStatus::kInterrupted, {"replaced", {describe(command)}});
  answer(command, ResultStatus::kAccepted);
  running_->command = command;
  running_->name = describe(command);
  return true;
}

bool CommandArbiter::adopt_kick(const Command& command) {
  const auto* action = std::get_if<ActionCommand>(&command.request);
  if (action == nullptr || waiting_ || !running_) return false;
  const Action* known = model_->find_action(action->action);
  const bool is_kick = known != nullptr && known->kind == Action::Kind::kKick;
  // A strength that is not given is NaN, for which the comparison is false.
  if (!is_kick || action->strength > kMaxWalkKickStrength) return false;
  if (!running_->generator->adopt(command)) return false;
  if (walk_kick_) {
    answer(*walk_kick_, ResultStatus::kInterrupted, {"replaced", {describe(command)}});
  }
  answer(command, ResultStatus::kAccepted);
  walk_kick_ = command;
  return true;
}

bool CommandArbiter::overlay_walk(const Command& command, const MotionContext& context,
                                  const JointTargets& targets) {
  const auto* change = std::get_if<JointChangeCommand>(&command.request);
  if (change == nullptr || waiting_ || !is_walking()) return false;
  // The change continues from the velocities of its own joints; the others belong to the walk.
  JointTargets start = targets;
  std::fill(start.velocity.begin(), start.velocity.end(), 0.0);
  for (const std::string& name : change->joint_names) {
    const int motor = model_->find_motor(name);
    // A leg joint cannot be overlaid: false leads to a motion that replaces the walk.
    if (carries_body(context, motor)) return false;
    start.velocity[motor] = targets.velocity[motor];
  }
  if (const auto danger = guard_->find_self_collision(*change, context, start)) {
    answer(command, ResultStatus::kRefused, *danger);
    return true;
  }
  answer(command, ResultStatus::kAccepted);
  if (has_overlay()) {
    answer(*overlay_.command(), ResultStatus::kInterrupted, {"replaced", {describe(command)}});
  }
  overlay_.start(command, context, start);
  return true;
}

void CommandArbiter::assign(Assignment assignment) {
  // At most one motion waits: that of the newest command. Joints that a change of the same tick
  // makes limp or stiff still become so.
  if (waiting_ && !waiting_->has_waited) {
    assignment.generator->continue_ramps(waiting_->generator->unfinished_ramps(*model_));
  }
  end_waiting(ResultStatus::kInterrupted, {"replaced-before-start"});
  waiting_ = std::move(assignment);
}

// After a fall, or without a robot, every command that is not finished gets its final result.
void CommandArbiter::abort_all(const Reason& reason) {
  end_running(ResultStatus::kFailed, reason);
  end_overlay(ResultStatus::kFailed, reason);
  overlay_.release();
  end_waiting(ResultStatus::kFailed, reason);
  if (walk_kick_) answer(*walk_kick_, ResultStatus::kFailed, reason);
  walk_kick_.reset();
}

void CommandArbiter::start(Assignment assignment, const MotionContext& context,
                           const JointTargets& targets) {
  running_ = std::move(assignment);
  running_->generator->start(context, targets);
}

void CommandArbiter::hand_over(std::unique_ptr<MotionGenerator> generator,
                               const MotionContext& context, const JointTargets& targets) {
  running_->generator = std::move(generator);
  running_->generator->start(context, targets);
}

void CommandArbiter::start_waiting(const MotionContext& context, const JointTargets& targets) {
  if (!waiting_) return;
  // Safe postures are between the steps of a walk, not within; finish() asks for the next one.
  if (running_ && !running_->generator->can_be_replaced()) {
    // A motion that cannot be left at once (a step, a get-up) first reaches its next safe posture.
    running_->generator->finish();
    waiting_->has_waited = true;
    return;
  }
  MotionGenerator& newer = *waiting_->generator;
  if (has_overlay()) newer.continue_ramps(overlay_.unfinished_ramps(*model_));
  if (running_) newer.continue_ramps(running_->generator->unfinished_ramps(*model_));
  end_running(ResultStatus::kInterrupted, replaced_by(*waiting_));
  end_overlay(ResultStatus::kInterrupted, replaced_by(*waiting_));
  if (const auto danger = find_new_danger(context, targets)) {
    end_waiting(ResultStatus::kFailed, *danger);
    return;
  }
  Assignment next = std::move(*waiting_);
  waiting_.reset();
  start(std::move(next), context, targets);
}

std::optional<Reason> CommandArbiter::find_new_danger(const MotionContext& context,
                                                      const JointTargets& targets) {
  // What was safe when the command came may be unsafe after the motion that it waited for.
  if (!waiting_->has_waited || !waiting_->command) return std::nullopt;
  const auto* change = std::get_if<JointChangeCommand>(&waiting_->command->request);
  return change == nullptr ? std::nullopt : guard_->find_danger(*change, context, targets);
}

std::optional<CommandArbiter::EndedMotion> CommandArbiter::step(const MotionContext& context,
                                                                JointTargets& targets) {
  // The overlay starts from the targets before this tick's motion wrote its own.
  const JointTargets last = targets;
  const std::optional<EndedMotion> ended = step_running(context, targets);
  watch_kick();
  step_overlay(context, last, targets);
  return ended;
}

std::optional<CommandArbiter::EndedMotion> CommandArbiter::step_running(
    const MotionContext& context, JointTargets& targets) {
  if (!running_) return std::nullopt;
  const Phase phase = running_->generator->step(context, targets);
  if (phase == Phase::kRunning) return std::nullopt;
  const EndedMotion ended{phase, running_->generator->mode(),
                          running_->command && keeps_body(*running_->command)};
  const Reason reason = running_->generator->reason();
  end_running(phase == Phase::kDone ? ResultStatus::kDone : ResultStatus::kFailed, reason);
  return ended;
}

// The kick during a walk has no motion of its own: the walk's state shows its end.
void CommandArbiter::watch_kick() {
  if (!walk_kick_) return;
  const auto strike = running_ ? running_->generator->strike() : MotionGenerator::Strike::kNone;
  switch (strike) {
    case MotionGenerator::Strike::kPending:
      return;
    case MotionGenerator::Strike::kStruck:
      answer(*walk_kick_, ResultStatus::kDone);
      break;
    case MotionGenerator::Strike::kMissed:
      answer(*walk_kick_, ResultStatus::kFailed, {"kick-missed"});
      break;
    case MotionGenerator::Strike::kNone:
      answer(*walk_kick_, ResultStatus::kFailed, {"walk-ended-before-kick"});
      break;
  }
  walk_kick_.reset();
}

void CommandArbiter::step_overlay(const MotionContext& context, const JointTargets& last,
                                  JointTargets& targets) {
  if (const auto remark = overlay_.step(context, last)) end_overlay(ResultStatus::kDone, *remark);
  // The overlay's joints keep their angles until the walk ends: then the next motion starts from
  // them.
  if (!has_overlay() && !is_walking()) overlay_.release();
  overlay_.write(targets);
}

void CommandArbiter::end_running(ResultStatus status, const Reason& reason) {
  if (running_ && running_->command) answer(*running_->command, status, reason);
  running_.reset();
}

void CommandArbiter::end_waiting(ResultStatus status, const Reason& reason) {
  if (waiting_ && waiting_->command) answer(*waiting_->command, status, reason);
  waiting_.reset();
}

void CommandArbiter::end_overlay(ResultStatus status, const Reason& reason) {
  if (has_overlay()) answer(*overlay_.command(), status, reason);
  overlay_.stop();
}

void CommandArbiter::answer(const Command& command, ResultStatus status, const Reason& reason) {
  const CommandResult result{command.source, command.id, kind_of(command), status, reason};
  ledger_.note(result);
  if (status == ResultStatus::kRefused) last_refusal_ = reason;
  results_.push_back(result);
}

}  // namespace nao::motion
