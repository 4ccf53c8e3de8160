#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace nao::robot {

/** The newest latencies, for their percentile. */
class LatencyRecord {
 public:
  /** @param latency  s. */
  void note(double latency) {
    latencies_[num_noted_ % latencies_.size()] = latency;
    ++num_noted_;
  }
  /** 99th percentile, s; 0 if there is none. */
  double p99() const {
    std::array<double, kCount> sorted = latencies_;
    const size_t count = std::min(num_noted_, sorted.size());
    if (count == 0) return 0;
    const auto rank = static_cast<long>((count - 1) * 99 / 100);
    std::nth_element(sorted.begin(), sorted.begin() + rank,
                     sorted.begin() + static_cast<long>(count));
    return sorted[static_cast<size_t>(rank)];
  }

 private:
  /** 12 s of frames. */
  static constexpr size_t kCount = 1000;
  std::array<double, kCount> latencies_{};
  size_t num_noted_ = 0;
};

}  // namespace nao::robot
