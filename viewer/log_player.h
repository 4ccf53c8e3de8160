#pragma once

#include <algorithm>
#include <utility>

#include "viewer/log_file.h"

namespace nao::viewer {

/** Plays a log: advances with the wall clock, or jumps to any time. */
class LogPlayer {
 public:
  explicit LogPlayer(LogFile log) : log_(std::move(log)) {}

  /** Advances by `seconds` of wall time and visits the messages of that time. Pauses at the end. */
  void advance(double seconds, const LogFile::Visitor& visit) {
    if (is_paused || seconds <= 0) return;
    const double from = time_;
    time_ = std::min(time_ + speed * seconds, log_.duration());
    log_.read(from, time_, visit);
    if (time_ >= log_.duration()) is_paused = true;
  }

  /** Jumps to a time and visits the newest message of each channel, and all messages of the
   * `window` seconds before. */
  void seek(double time, double window, const LogFile::Visitor& visit) {
    time_ = std::clamp(time, 0.0, log_.duration());
    log_.read_latest(time_ - window, visit);
    log_.read(time_ - window, time_, visit);
  }

  /** Time since the first message of the log, s. */
  double time() const { return time_; }
  double duration() const { return log_.duration(); }

  bool is_paused = false;
  /** Recorded seconds per second of wall time. */
  double speed = 1;

 private:
  LogFile log_;
  /** Starts before the first message, at 0, so that advance() visits it. */
  double time_ = -1e-9;
};

}  // namespace nao::viewer
