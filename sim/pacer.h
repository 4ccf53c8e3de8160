#pragma once

#include <algorithm>

namespace nao::sim {

/** Says when the next control tick is due by the wall clock, so that simulated time keeps up with
 * it. Late ticks are made up for, but never in a burst, and a long stop (a suspended machine) is
 * left out. Times are seconds of a clock that never jumps; all calls take the present one. */
class Pacer {
 public:
  /** @param period  Simulated time of a tick, s. */
  explicit Pacer(double period) : period_(period) {}

  /** @param pace  Simulated seconds per wall second, 0 as fast as possible. */
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

  /** How late a tick that begins now is, s; 0 if as fast as possible. */
  double lateness(double now) const { return pace_ > 0 ? std::max(0.0, now - due_) : 0.0; }

  /** A tick began at `now`. */
  void tick(double now) {
    due_ += wall_period();
    // Backlog is made up for at twice the pace at most.
    earliest_ = now + wall_period() / 2;
    if (now - due_ > kLongestBacklog) restart(now);
  }

  /** Greatest delay that is made up for, s. */
  static constexpr double kLongestBacklog = 0.5;

 private:
  double wall_period() const { return pace_ > 0 ? period_ / pace_ : 0; }

  double period_;
  double pace_ = 1;
  double due_ = 0;
  double earliest_ = 0;
};

}  // namespace nao::sim
