#include "daemons/motion/state_reporter.h"

#include <utility>

#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

// A sum of time steps may be this much below the period by rounding, s; waiting for one more step
// would make the period longer by that step.
constexpr double kPeriodRounding = 1e-6;

/** Whether a report is due at once. Quantities that change in every step do not count. */
bool has_changed(const MotionState& a, const MotionState& b) {
  return a.mode != b.mode || a.posture != b.posture || a.command_kind != b.command_kind ||
         a.command_source != b.command_source || a.command_id != b.command_id ||
         a.command_name != b.command_name || a.needs_help != b.needs_help ||
         a.last_refusal != b.last_refusal;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// The complete report of this tick; whether it is sent is decided in update().
MotionState build(const StateReporter::Inputs& inputs) {
  const MotionContext& context = inputs.context;
  const Assignment* running = inputs.commands.running();
  MotionState state;
  state.utime = context.sensors.utime;
  state.mode = inputs.mode;
  state.last_refusal = inputs.commands.last_refusal();
  if (inputs.mode != Mode::kNoRobot) {
    state.balance_margin = context.state.balance_margin;
    state.stiffness = mean(inputs.targets.stiffness);
    if (running == nullptr) {
      const Posture* posture = find_present_posture(context.model, context.sensors.position,
                                                    context.state, context.options);
      if (posture != nullptr) state.posture = posture->name;
    }
  }
  if (running != nullptr) {
    if (running->command) {
      state.command_kind = kind_of(*running->command);
      state.command_source = running->command->source;
      state.command_id = running->command->id;
    }
    state.command_name = running->name;
    state.command_progress = running->generator->progress();
    running->generator->describe(state);
  }
  state.needs_help = inputs.needs_help && running == nullptr;
  return state;
}

}  // namespace

std::optional<MotionState> StateReporter::update(const Inputs& inputs, double dt) {
  MotionState state = build(inputs);
  time_since_report_ += dt;
  const bool changes = has_changed(state, state_);
  const bool is_due = time_since_report_ >= period_ - kPeriodRounding;
  state_ = std::move(state);
  // A change is reported at once, and the period restarts.
  if (changes) {
    time_since_report_ = 0;
    return state_;
  }
  if (!is_due) return std::nullopt;
  // Control steps need not divide the period: the remainder counts for the next report, so that
  // the mean rate is kept. After a pause of several periods one report is enough.
  time_since_report_ -= period_;
  if (time_since_report_ >= period_) time_since_report_ = 0;
  return state_;
}

}  // namespace nao::motion
