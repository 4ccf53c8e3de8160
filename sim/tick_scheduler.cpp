#include "sim/tick_scheduler.h"

#include <algorithm>

namespace nao::sim {
namespace {

/** Delay above which a tick counts as late, s; world_truth_t has the same number. */
constexpr double kLateTick = 0.002;
/** Time without a command after which a robot has no controller, s; joint_command_t has the same
 * number. */
constexpr double kSilence = 0.5;
/** Control periods after the last tick that a tick waits for a missing answer. Chosen: commands may
 * be one or two ticks late without a fall. */
constexpr double kMaxWaitPeriods = 3;
/** Time within which the controller must have answered for a tick to wait for it, s. Chosen: longer
 * than any wait, shorter than kSilence. */
constexpr double kActive = 0.1;
/** The answers to every tick of this multiple are read as they arrive, so that AnswerLatency knows
 * when. Chosen: three of them in its window of a second. */
constexpr int64_t kMeasuredTick = 32;

}  // namespace

TickScheduler::TickScheduler(int num_robots, double period, bool is_lock_step, double pace)
    : period_(period), is_lock_step_(is_lock_step), pacer_(period), commands_(num_robots) {
  // In lock-step the answers decide; the pacer waits only if set_pace() says so.
  pacer_.set_pace(is_lock_step ? 0 : pace, 0);
}

void TickScheduler::resume(double now) {
  is_paused_ = false;
  ticks_to_step_ = 0;
  restart(now);
}

// Single steps leave the simulator paused when they are done.
void TickScheduler::step(int64_t num_ticks, double now) {
  is_paused_ = true;
  ticks_to_step_ += num_ticks;
  restart(now);
}

// Ticks count from 0 again: answers to ticks of the last run must not let the first ticks pass.
void TickScheduler::reset(double now) {
  ticks_to_step_ = 0;
  for (Commands& commands : commands_) commands.answered_tick = -1;
  restart(now);
}

bool TickScheduler::note_command(int robot, int64_t answered_tick, double now) {
  Commands& commands = commands_[robot];
  const bool is_repeated = answered_tick > 0 && answered_tick == commands.answered_tick;
  // Commands may arrive out of order; the newest tick counts.
  commands.answered_tick = std::max(commands.answered_tick, answered_tick);
  commands.time = now;
  commands.has_any = true;
  commands.latency.note_answer(answered_tick, now);
  return is_repeated;
}

bool TickScheduler::may_run(int64_t tick) const {
  if (is_stopped()) return false;
  return awaited_robot(tick) < 0;
}

int TickScheduler::awaited_robot(int64_t tick) const {
  if (!is_lock_step_) return -1;
  // Lock-step: every robot's controller has answered exactly this tick's sensor state.
  const auto missing =
      std::find_if(commands_.begin(), commands_.end(),
                   [tick](const Commands& commands) { return commands.answered_tick != tick; });
  return missing == commands_.end() ? -1 : static_cast<int>(missing - commands_.begin());
}

double TickScheduler::next_time(int64_t tick, double now) const {
  const double due = pacer_.next(now);
  if (is_lock_step_ || pacer_.pace() == 0 || pacer_.is_in_batch()) return due;
  // In real time a tick waits for an answer only where one can be expected: the controller has been
  // active, has not answered yet, and is fast enough to answer within a period. A dead controller
  // delays nothing after kActive.
  const bool is_awaited =
      std::any_of(commands_.begin(), commands_.end(), [&](const Commands& commands) {
        return commands.has_any && commands.answered_tick < tick && now - commands.time < kActive &&
               commands.latency.least() < period_;
      });
  return is_awaited ? std::max(due, last_tick_time_ + kMaxWaitPeriods * period_) : due;
}

std::optional<double> TickScheduler::next_reading(int64_t tick, double now) const {
  if (is_lock_step_ || is_paused_ || pacer_.is_in_batch() || tick % kMeasuredTick == 0) {
    return std::nullopt;
  }
  // A tick that is due waits for an answer; one of a slow pace is not due for long.
  const double due = pacer_.next(now);
  return due > now && due <= now + period_ ? std::optional(due) : std::nullopt;
}

double TickScheduler::begin_tick(int64_t tick, double now) {
  const double delay = pacer_.delay(now);
  if (delay > kLateTick && !is_lock_step_) ++num_late_ticks_;
  // A late command is counted once per tick for every robot that is under control. In a batch only
  // the last tick is answered.
  for (Commands& commands : commands_) {
    const bool is_active =
        commands.has_any && now - commands.time < kSilence && !pacer_.is_in_batch();
    if (is_active && commands.answered_tick < tick) ++num_late_commands_;
    commands.latency.note_tick(tick + 1, now);
  }
  pacer_.tick(now);
  last_tick_time_ = now;
  if (ticks_to_step_ > 0) --ticks_to_step_;
  return delay;
}

}  // namespace nao::sim
