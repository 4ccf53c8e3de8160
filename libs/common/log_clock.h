#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace nao {

/** Continuous times of a recording whose computer's clock stepped, or some of whose messages have
 * damaged times. The order of the messages is that of the recording.
 *
 * A time before that of the message before is a step of the clock, and so is a gap of more than an
 * hour, or of more than 10 s that the robot's time contradicts by more than 1 s. A step is bridged:
 * it takes as long as the robot's time says, or none. */
class LogClock {
 public:
  /** @param wall_utime   When the message was received, us since 1970.
   * @param channel       Of the message.
   * @param robot_utime   Robot time that it holds, us; 0: none.
   * @return Its time without steps, us, not before that of the message before. */
  int64_t take(int64_t wall_utime, const std::string& channel, int64_t robot_utime);

  /** Number of steps of 0.1 s or more so far, and the size of the longest, s. */
  int64_t num_steps() const { return num_steps_; }
  double longest_step() const { return longest_step_; }

 private:
  struct Moment {
    int64_t robot_utime;
    int64_t utime;
  };

  bool has_begun_ = false;
  int64_t last_wall_utime_ = 0;
  int64_t last_utime_ = 0;
  /** Newest message with a robot time, by channel. */
  std::map<std::string, Moment> robot_times_;
  int64_t num_steps_ = 0;
  double longest_step_ = 0;
};

}  // namespace nao
