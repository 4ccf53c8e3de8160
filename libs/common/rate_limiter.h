#pragma once

#include <cstdint>
#include <optional>

namespace nao {

/** Passes one event per period and counts the suppressed ones. */
class RateLimiter {
 public:
  /** @param period  Minimum time between two passed events, s. */
  explicit RateLimiter(double period) : period_(period) {}

  /** Decides whether an event at time `now` (s, non-decreasing) passes.
   * @return Number of events suppressed since the last passed event; nullopt if this one is
   * suppressed. */
  std::optional<int64_t> allow(double now) {
    if (has_passed_ && now - last_ < period_) {
      ++num_suppressed_;
      return std::nullopt;
    }
    has_passed_ = true;
    last_ = now;
    const int64_t num_suppressed = num_suppressed_;
    num_suppressed_ = 0;
    return num_suppressed;
  }

 private:
  double period_;
  double last_ = 0;
  bool has_passed_ = false;
  int64_t num_suppressed_ = 0;
};

}  // namespace nao
