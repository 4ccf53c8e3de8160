#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nao::sim {

/** How soon a motion answers ticks at best. Times: s, of any clock that only goes ahead. */
class AnswerDelay {
 public:
  void note_tick(int64_t tick, double now) { ticks_[place(tick)] = {tick, now}; }

  void note_answer(int64_t tick, double now) {
    if (tick < 0 || ticks_[place(tick)].number != tick) return;
    if (now - window_start_ > kWindow) {
      last_least_ = now - window_start_ > 2 * kWindow ? kNever : least_;
      least_ = kNever;
      window_start_ = now;
    }
    least_ = std::min(least_, now - ticks_[place(tick)].time);
  }

  /** Of the answers in the last second or two; infinite if there was none, or none to a tick of
   * late. */
  double least() const { return std::min(least_, last_least_); }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kWindow = 1;
  static constexpr size_t kRememberedTicks = 128;

  struct Tick {
    int64_t number = -1;
    double time = 0;
  };

  static size_t place(int64_t tick) { return static_cast<size_t>(tick) % kRememberedTicks; }

  std::array<Tick, kRememberedTicks> ticks_;
  double window_start_ = -std::numeric_limits<double>::max();
  double least_ = kNever;
  double last_least_ = kNever;
};

}  // namespace nao::sim
