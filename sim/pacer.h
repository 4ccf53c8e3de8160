#pragma once

#include <algorithm>

namespace nao::sim {

/** Schedules control ticks so that simulated time keeps pace with the wall clock.
 *
 * Late ticks are made up at no more than twice the pace; a delay of more than kMaxBacklog (a
 * suspended machine) is skipped. Times are seconds of a monotonic clock; all calls take the present
 * one. */
class Pacer {
 public:
  /** @param period  Simulated time of a tick, s. */
  explicit Pacer(double period) : period_(period) {}

  /** @param pace  Simulated seconds per wall second, 0 for as fast as possible. */
  void set_pace(double pace, double now) {
    pace_ = pace;
    restart(now);
  }
  double pace() const { return pace_; }

  /** The next tick is due one period from now: at the start and after a pause. */
  void restart(double now) {
    due_ = now + wall_period();
    earliest_ = now;
  }

  /** When to run the next tick; not after `now` means at once. */
  double next(double now) const { return pace_ > 0 ? std::max(due_, earliest_) : now; }

  /** Delay of a tick that begins now behind its due time, s; 0 if as fast as possible. */
  double delay(double now) const { return pace_ > 0 ? std::max(0.0, now - due_) : 0.0; }

  /** A tick began at `now`. */
  void tick(double now) {
    due_ += wall_period();
    earliest_ = now + wall_period() / 2;
    if (now - due_ > kMaxBacklog) restart(now);
  }

  /** Largest delay that is made up, s. Chosen: half a second at twice the pace is hardly visible,
   * and a walk command is valid for as long. */
  static constexpr double kMaxBacklog = 0.5;

 private:
  double wall_period() const { return pace_ > 0 ? period_ / pace_ : 0; }

  double period_;
  double pace_ = 1;
  double due_ = 0;
  double earliest_ = 0;
};

}  // namespace nao::sim
