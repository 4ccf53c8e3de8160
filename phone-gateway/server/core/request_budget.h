#pragma once

#include <algorithm>

namespace nao::gateway {

/** Limits the rate of requests: a token bucket that holds one second's worth and is filled at the
 * allowed rate. */
class RequestBudget {
 public:
  /** @param rate  Requests a second. @param now  s. */
  RequestBudget(double rate, double now) : rate_(rate), left_(rate), last_(now) {}

  /** @return false if there is none left. */
  bool take(double now) {
    left_ = std::min(rate_, left_ + (now - last_) * rate_);
    last_ = now;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double rate_;
  double left_;
  double last_;
};

}  // namespace nao::gateway
