#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nao::sim {

/** Least time between a control tick and the joint command that answers it, over the last one to
 * two seconds. Times: s of a monotonic clock. */
class AnswerLatency {
 public:
  /** The sensor state of a tick was sent. */
  void note_tick(int64_t tick, double now) { ticks_[index_of(tick)] = {tick, now}; }

  /** The answer to a tick was received. Ignored if the tick is not among the last 128. */
  void note_answer(int64_t tick, double now) {
    if (tick < 0 || ticks_[index_of(tick)].number != tick) return;
    if (now - window_start_ > kWindow) {
      last_least_ = now - window_start_ > 2 * kWindow ? kNever : least_;
      least_ = kNever;
      window_start_ = now;
    }
    least_ = std::min(least_, now - ticks_[index_of(tick)].time);
  }

  /** Latency, s; infinite if there was no answer. */
  double least() const { return std::min(least_, last_least_); }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  /** Length of a window, s: the minimum is that of the present and the last one. Chosen: long
   * compared with a pause of the other program, short compared with a person's patience. */
  static constexpr double kWindow = 1;
  /** More than a second of ticks: later answers say nothing about the present. */
  static constexpr size_t kNumTicks = 128;

  struct Tick {
    int64_t number = -1;
    double time = 0;
  };

  static size_t index_of(int64_t tick) { return static_cast<size_t>(tick) % kNumTicks; }

  std::array<Tick, kNumTicks> ticks_;
  double window_start_ = -std::numeric_limits<double>::max();
  double least_ = kNever;
  double last_least_ = kNever;
};

}  // namespace nao::sim
