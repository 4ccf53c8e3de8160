#pragma once

#include <cmath>

namespace nao {

/** Thins a stream that arrives at its own rhythm to a wished rate.
 *
 * On the average it lets through `rate` events a second, or all of them if fewer come. An event may
 * pass up to half a period early, so that a stream of just the wished rate passes whole in spite of
 * its jitter. Of streams that begin together and are thinned to one rate, those with different
 * phases let different events through. */
class Pacer {
 public:
  /** @param rate  Events a second to let through; 0 for none.
   * @param phase  Share of a period by which it is late, [0, 1); the first event passes at once. */
  explicit Pacer(double rate = 0, double phase = 0) : rate_(rate), phase_(phase) {}

  double rate() const { return rate_; }

  /** @param now  s, never running backwards. @return true if the event of this moment may pass. */
  bool allow(double now) {
    if (rate_ <= 0) return false;
    const double period = 1 / rate_;
    if (!has_begun_) {
      has_begun_ = true;
      due_ = now + phase_ * period;
      return true;
    }
    if (now < due_ - period / 2) return false;
    // What a pause left out is not made up for; the phase stays.
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

}  // namespace nao
