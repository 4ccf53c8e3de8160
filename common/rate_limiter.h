#pragma once

#include <cstdint>
#include <optional>

namespace nao {

/** Lets one event through per period and counts the ones that it keeps back. */
class RateLimiter {
 public:
  /** @param period  Least time between two events let through, s. */
  explicit RateLimiter(double period) : period_(period) {}

  /** Asks whether an event at time `now` (s, never running backwards) may pass.
   * @return How many were kept back since the last one that passed, or nothing if this one is. */
  std::optional<int64_t> allow(double now) {
    if (has_passed_ && now - last_ < period_) {
      ++num_kept_back_;
      return std::nullopt;
    }
    has_passed_ = true;
    last_ = now;
    const int64_t num_kept_back = num_kept_back_;
    num_kept_back_ = 0;
    return num_kept_back;
  }

 private:
  double period_;
  double last_ = 0;
  bool has_passed_ = false;
  int64_t num_kept_back_ = 0;
};

}  // namespace nao
