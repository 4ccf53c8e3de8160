#pragma once

#include <algorithm>
#include <cmath>

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
    num_in_batch_ = 0;
    due_ = now + wall_period();
    earliest_ = now;
  }

  /** When to run the next tick; not after `now` means at once. */
  double next(double now) const {
    if (pace_ <= 0) return now;
    return is_in_batch() ? batch_due_ : std::max(due_, earliest_);
  }

  /** Delay of a tick that begins now behind its due time, s; 0 if as fast as possible. */
  double delay(double now) const {
    return pace_ > 0 ? std::max(0.0, now - (is_in_batch() ? batch_due_ : due_)) : 0.0;
  }

  /** A tick began at `now`. */
  void tick(double now) {
    due_ += wall_period();
    if (is_in_batch()) --num_in_batch_;
    earliest_ = now + wall_period() / 2;
    if (now - due_ > kMaxBacklog) restart(now);
  }

  /** The next ticks are run together, when the last of them is due. */
  void begin_batch(int num_ticks) {
    num_in_batch_ = num_ticks;
    batch_due_ = due_ + (num_ticks - 1) * wall_period();
  }
  /** Ticks of the batch are left to run. */
  bool is_in_batch() const { return num_in_batch_ > 0; }
  /** Ends the batch; its ticks that are due are run at once. */
  void shorten_batch(double now) {
    const double num_due = std::floor((now - due_) / wall_period()) + 1;
    num_in_batch_ = static_cast<int>(std::clamp(num_due, 0.0, 1.0 * num_in_batch_));
    batch_due_ = now;
  }
  /** Ends the batch; its ticks are late. */
  void drop_batch() { num_in_batch_ = 0; }

  /** Largest delay that is made up, s. Chosen: half a second at twice the pace is hardly visible,
   * and a walk command is valid for as long. */
  static constexpr double kMaxBacklog = 0.5;

 private:
  double wall_period() const { return pace_ > 0 ? period_ / pace_ : 0; }

  double period_;
  double pace_ = 1;
  double due_ = 0;
  double earliest_ = 0;
  int num_in_batch_ = 0;
  double batch_due_ = 0;
};

}  // namespace nao::sim
