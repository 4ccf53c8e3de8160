#include "common/log_clock.h"

#include <algorithm>
#include <cmath>

namespace nao {
namespace {

// All in us. Chosen: every program of the bus speaks once a second, so that gaps are rare; a
// recording of commands only may have one of many minutes.
constexpr double kShortGap = 10'000'000;
constexpr double kLongGap = 3'600'000'000;
constexpr double kTolerance = 1'000'000;
// Below it a clock is being adjusted, and nobody needs to know.
constexpr double kSmallStep = 100'000;

// A first message of a later time than 30000 years after 1970 is damaged, us.
constexpr int64_t kLatestStart = 1'000'000'000'000'000'000;

}  // namespace

int64_t LogClock::take(int64_t wall_utime, const std::string& channel, int64_t robot_utime) {
  if (!has_begun_) {
    last_wall_utime_ = wall_utime;
    last_utime_ = std::clamp<int64_t>(wall_utime, 0, kLatestStart);
  }
  // Damaged times may be too far apart for the difference of integers.
  const double gap = static_cast<double>(wall_utime) - static_cast<double>(last_wall_utime_);
  int64_t utime = last_utime_;
  if (gap >= 0 && gap <= kShortGap) {
    utime += wall_utime - last_wall_utime_;
  } else {
    const auto before = robot_times_.find(channel);
    const bool has_robot_time = robot_utime != 0 && before != robot_times_.end();
    // Since the message before, which may be of another channel.
    const double robot_gap = has_robot_time
                                 ? static_cast<double>(robot_utime) -
                                       static_cast<double>(before->second.robot_utime) +
                                       static_cast<double>(before->second.utime - last_utime_)
                                 : 0;
    const bool is_contradicted = has_robot_time && std::abs(gap - robot_gap) > kTolerance;
    const bool is_step = gap < 0 || gap > kLongGap || is_contradicted;
    utime += static_cast<int64_t>(is_step ? std::clamp(robot_gap, 0.0, kLongGap) : gap);
    if (is_step && std::abs(gap) >= kSmallStep) {
      ++num_steps_;
      longest_step_ = std::max(longest_step_, std::abs(gap) * 1e-6);
    }
  }
  has_begun_ = true;
  last_wall_utime_ = wall_utime;
  last_utime_ = utime;
  if (robot_utime != 0) robot_times_[channel] = {robot_utime, utime};
  return utime;
}

}  // namespace nao
