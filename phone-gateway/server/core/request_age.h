#pragma once

#include <algorithm>

namespace nao::gateway {

/** How much later than usual a client's requests arrive.
 *
 * The clocks of client and gateway are not related. The least difference between arrival and
 * sending in the last half minute stands for a request that nothing held up; what a request takes
 * longer than that is its age. A clock that is set back counts as age for half a minute, one that
 * is set ahead does not. */
class RequestAge {
 public:
  /** @param sent_at  On the client's clock, s; 0: not told. @param now  On the gateway's, s.
   * @return Age, s; 0 if it is not known. */
  double take(double sent_at, double now) {
    if (!(sent_at > 0)) return 0;
    if (now - period_start_ >= kPeriod) {
      previous_ = current_;
      current_ = kNone;
      period_start_ = now;
    }
    const double difference = now - sent_at;
    current_ = std::min(current_, difference);
    return difference - std::min(current_, previous_);
  }

 private:
  /** Duration of each of two periods, s. Chosen: clocks differ by 100 parts in a million at most, 3
   * ms in it. */
  static constexpr double kPeriod = 15;
  static constexpr double kNone = 1e300;

  double period_start_ = -1e9;
  /** Least differences in the present period and the one before, s. */
  double current_ = kNone;
  double previous_ = kNone;
};

}  // namespace nao::gateway
