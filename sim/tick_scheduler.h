#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/answer_latency.h"
#include "sim/pacer.h"

namespace nao::sim {

/** Decides when the next control tick is run: pace, pause and single steps, and the joint commands
 * that answer the ticks. Times: s of a monotonic clock that the caller reads.
 *
 * In lock-step a tick is run as soon as all robots' commands for the one before are there.
 * Otherwise it is run when it is due by the wall clock; if a robot's controller is nearby (it has
 * recently answered within a period) and its answer is missing, the tick waits for it, up to three
 * periods after the last tick: on a busy machine a world that is a little late is better than a
 * robot that falls. It does not wait for controllers at the far end of a slow network, which would
 * slow down the world permanently. */
class TickScheduler {
 public:
  /** The clock begins at 0. @param period  Control period, s. @param pace  As set_pace(); in
   * lock-step 0. */
  TickScheduler(int num_robots, double period, bool is_lock_step, double pace);

  /** The next tick is due one period from now. */
  void restart(double now) { pacer_.restart(now); }

  bool is_lock_step() const { return is_lock_step_; }
  /** Simulated seconds per wall second, 0 for as fast as possible; in lock-step the greatest. */
  double pace() const { return pacer_.pace(); }
  void set_pace(double pace, double now) { pacer_.set_pace(pace, now); }
  bool is_paused() const { return is_paused_; }
  /** Paused, with no single steps left to run. */
  bool is_stopped() const { return is_paused_ && ticks_to_step_ == 0; }
  void pause() { is_paused_ = true; }
  void resume(double now);
  /** Runs so many ticks, after those requested before, and pauses. */
  void step(int64_t num_ticks, double now);
  /** The world was reset to tick 0. */
  void reset(double now);

  void add_robot() { commands_.emplace_back(); }
  /** The indices of the robots after it fall by one. */
  void remove_robot(int robot) { commands_.erase(commands_.begin() + robot); }

  /** A robot's joint command was received. @param answered_tick  Tick of the sensor state.
   * @return Whether that tick had been answered before. */
  bool note_command(int robot, int64_t answered_tick, double now);

  /** The ticks after `tick` are run together, up to the next multiple of `num_ticks`, without
   * waiting for answers. In real time only. */
  void rest(int64_t tick, int num_ticks) {
    pacer_.begin_batch(num_ticks - static_cast<int>(tick % num_ticks));
  }
  /** Ticks are left that are run together with the last one: its sensor state is not sent. */
  bool is_in_batch() const { return pacer_.is_in_batch(); }
  /** Ends the batch: those of its ticks that are due are run at once. */
  void wake(double now) {
    if (is_in_batch()) pacer_.shorten_batch(now);
  }
  /** Ends the batch before its last tick was run. */
  void drop_batch() { pacer_.drop_batch(); }

  /** Ticks between two sensor states of a world at rest. nao-motion takes up to so many for one
   * step. */
  static constexpr int kRestTicks = 10;
  /** The same while images are requested, at most 30 a second (camera_command_t). */
  static constexpr int kRestTicksWithImages = 3;

  /** Whether the tick after `tick` may be run, as far as pause and lock-step decide. */
  bool may_run(int64_t tick) const;
  /** A robot whose answer to `tick` lock-step waits for; -1: none. */
  int awaited_robot(int64_t tick) const;
  /** When to run it, if it may be run; not after `now` means at once. */
  double next_time(int64_t tick, double now) const;
  /** When the tick after `tick` is due, if commands that arrive until then may be read then, since
   * they take effect in ticks only; nothing if they must be read as they arrive. */
  std::optional<double> next_reading(int64_t tick, double now) const;
  /** The tick after `tick` begins. @return Its delay behind its due time, s. */
  double begin_tick(int64_t tick, double now);

  /** Ticks that began more than 2 ms after they were due. */
  int64_t num_late_ticks() const { return num_late_ticks_; }
  /** Ticks that began without the answer of a robot whose controller was active. */
  int64_t num_late_commands() const { return num_late_commands_; }

 private:
  /** Joint commands of one robot. */
  struct Commands {
    /** Newest tick that was answered; -1 if none. */
    int64_t answered_tick = -1;
    /** When the last command was received. */
    double time = 0;
    bool has_any = false;
    AnswerLatency latency{};
  };

  double period_;
  bool is_lock_step_;
  Pacer pacer_;
  std::vector<Commands> commands_;
  bool is_paused_ = false;
  int64_t ticks_to_step_ = 0;
  double last_tick_time_ = 0;
  int64_t num_late_ticks_ = 0;
  int64_t num_late_commands_ = 0;
};

}  // namespace nao::sim
