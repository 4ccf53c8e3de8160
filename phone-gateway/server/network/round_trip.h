#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace nao::gateway {

/** Round-trip time between gateway and phone, by the numbers that the phone acknowledges, where the
 * kernel does not know it. A phone sends at its own pace, up to which it is longer. */
class RoundTrip {
 public:
  /** @param number  Of what was sent, counted up. @param now  s */
  void sent(uint64_t number, double now) {
    frames_.emplace_back(number, now);
    if (frames_.size() > kMaxTimedFrames) frames_.pop_front();
  }
  /** @param num_received  All below that number have arrived. */
  void acknowledged(uint64_t num_received, double now) {
    std::optional<double> time;
    while (!frames_.empty() && frames_.front().first < num_received) {
      time = now - frames_.front().second;
      frames_.pop_front();
    }
    if (!time) return;
    least_ = least_ == 0 ? *time : std::min(least_, *time);
    mean_ = mean_ == 0 ? *time : mean_ + kNewRoundTripWeight * (*time - mean_);
  }
  /** s; 0: not known. */
  double mean() const { return mean_; }
  double least() const { return least_; }

 private:
  /** Frames whose acknowledgement is awaited. Chosen: a second of states. */
  static constexpr size_t kMaxTimedFrames = 128;
  /** Weight of a new round-trip time in the mean (RFC 6298, 2: alpha). */
  static constexpr double kNewRoundTripWeight = 0.125;

  std::deque<std::pair<uint64_t, double>> frames_;
  double mean_ = 0;
  double least_ = 0;
};

}  // namespace nao::gateway
