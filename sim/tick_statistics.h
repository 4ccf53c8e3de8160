#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nao::sim {

/** Duration and delay of the control ticks between two reports. Times: s of a monotonic clock. */
class TickStatistics {
 public:
  struct Report {
    int64_t num_ticks = 0;
    /** Simulated seconds per wall second. */
    double real_time_factor = 0;
    /** Mean duration of a tick, messages included, s; 0 without ticks. */
    double duration_mean = 0;
    /** 99th percentile of the ticks' delays behind their due times, s; 0 without ticks. */
    double delay_p99 = 0;
  };

  /** @param period  Simulated time of a tick, s. */
  TickStatistics(double period, double now) : period_(period), start_(now) {
    delays_.reserve(kMaxDelays);
  }

  void note_tick(double delay, double duration) {
    if (delays_.size() < kMaxDelays) delays_.push_back(delay);
    durations_ += duration;
    ++num_ticks_;
  }

  /** Reports on the ticks since the last report, and starts again. */
  Report report(double now) {
    Report report;
    report.num_ticks = num_ticks_;
    const auto count = static_cast<double>(num_ticks_);
    if (now > start_) report.real_time_factor = count * period_ / (now - start_);
    if (num_ticks_ > 0) report.duration_mean = durations_ / count;
    if (!delays_.empty()) {
      const auto p99 = delays_.begin() + static_cast<long>(delays_.size() * 99 / 100);
      std::nth_element(delays_.begin(), p99, delays_.end());
      report.delay_p99 = *p99;
    }
    start_ = now;
    delays_.clear();
    durations_ = 0;
    num_ticks_ = 0;
    return report;
  }

 private:
  /** Delays that are kept: as fast as possible, a second has more ticks, all without delay. */
  static constexpr size_t kMaxDelays = 4096;

  double period_;
  double start_;
  std::vector<double> delays_;
  double durations_ = 0;
  int64_t num_ticks_ = 0;
};

}  // namespace nao::sim
