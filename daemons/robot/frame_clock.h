#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nao::robot {

/** Computes the robot time of frames that carry none: each adds one period, and the sum follows the
 * clock of their arrival, so that their jitter does not affect robot time. */
class FrameClock {
 public:
  /** A frame's time. */
  struct Stamp {
    /** Microseconds. */
    int64_t utime = 0;
    /** Periods since the last frame: 1, or more after lost frames; 0 for the first frame. */
    int num_periods = 0;
  };

  /** @param period  s. @param counts_only  Frames are counted from 0 and the clock is ignored:
   * lock-step. */
  FrameClock(double period, bool counts_only) : period_(period), counts_only_(counts_only) {}

  /** A frame has arrived. @param now  s of a monotonic clock. */
  Stamp take(double now) {
    Stamp stamp;
    if (!has_time_) {
      time_ = counts_only_ ? 0 : now;
    } else if (counts_only_) {
      stamp.num_periods = 1;
      ++num_frames_;
      time_ = static_cast<double>(num_frames_) * period_;
    } else {
      const double num_late = std::floor((now - time_ - period_) / period_ + 0.5);
      stamp.num_periods = 1 + static_cast<int>(std::clamp(num_late, 0.0, kMaxLost));
      const double expected = time_ + period_ * (1 + std::max(0.0, num_late));
      time_ = std::max(time_, expected + kGain * (now - expected));
    }
    has_time_ = true;
    stamp.utime = std::llround(time_ * 1e6);
    return stamp;
  }

 private:
  /** Fraction of a frame's delay by which the time is corrected. Chosen: it follows a difference of
   * the clocks within 20 frames, and passes on a twentieth of the jitter. */
  static constexpr double kGain = 0.05;
  /** Bound of the number of lost frames. */
  static constexpr double kMaxLost = 1e6;

  double period_;
  bool counts_only_;
  bool has_time_ = false;
  double time_ = 0;
  int64_t num_frames_ = 0;
};

}  // namespace nao::robot
