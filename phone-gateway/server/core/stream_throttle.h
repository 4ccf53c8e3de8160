#pragma once

#include <cmath>

namespace nao::gateway {

/** Reduces a stream of events to a requested rate.
 *
 * On average it passes `rate` events a second, or all events if fewer arrive. An event may pass up
 * to half a period early, so that a stream of exactly the requested rate passes completely in spite
 * of its jitter. Of streams that are reduced to the same rate, those with the same phase pass the
 * same events, those with different phases different ones. */
class StreamThrottle {
 public:
  /** @param rate   Events a second to pass; 0: none.
   * @param phase  The second and later events are due at this fraction of a period, [0, 1), after
   *   multiples of the period. The first event passes at once. */
  explicit StreamThrottle(double rate = 0, double phase = 0) : rate_(rate), phase_(phase) {}

  /** @param now  s, never running backwards. @return true if the event at `now` passes. */
  bool allow(double now) {
    if (rate_ <= 0) return false;
    const double period = 1 / rate_;
    if (!has_begun_) {
      has_begun_ = true;
      due_ = (std::floor(now / period) + 1 + phase_) * period;
      return true;
    }
    if (now < due_ - period / 2) return false;
    // After a pause the missed events are not made up for, and the phase is kept: the next event is
    // due at the first due_ + n * period after `now`.
    const double num_periods = (now - due_) / period;
    due_ += period * (num_periods < 2 ? 1 : std::ceil(num_periods));
    return true;
  }

 private:
  double rate_;
  double phase_;
  bool has_begun_ = false;
  double due_ = 0;
};

}  // namespace nao::gateway
