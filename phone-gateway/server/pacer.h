#pragma once

#include <algorithm>

namespace nao {

/** Thins a stream that arrives at its own rhythm to a wished rate.
 *
 * On the average it lets through `rate` events a second, or all of them if fewer come. An event may
 * pass up to half a period early, so that a stream of just the wished rate passes whole in spite of
 * its jitter. */
class Pacer {
 public:
  /** @param rate  Events a second to let through; 0 for none. */
  explicit Pacer(double rate = 0) : rate_(rate) {}

  double rate() const { return rate_; }

  /** @param now  s, never running backwards. @return true if the event of this moment may pass. */
  bool allow(double now) {
    if (rate_ <= 0) return false;
    const double period = 1 / rate_;
    if (now < due_ - period / 2) return false;
    due_ = std::max(due_ + period, now);
    return true;
  }

 private:
  double rate_;
  double due_ = 0;
};

}  // namespace nao
