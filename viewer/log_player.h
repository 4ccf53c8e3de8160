#pragma once

#include <algorithm>
#include <utility>

#include "viewer/log_file.h"

namespace nao {

/** Place in a log: plays on by itself, or jumps where a person drags it. */
class LogPlayer {
 public:
  explicit LogPlayer(LogFile log) : log_(std::move(log)) {}

  /** Plays `seconds` of wall time on, and calls back for what was recorded in that time. */
  void advance(double seconds, const LogFile::Visitor& visit) {
    if (is_paused || seconds <= 0) return;
    const double from = time_;
    time_ = std::min(time_ + speed * seconds, log_.duration());
    log_.read(from, time_, visit);
    if (time_ >= log_.duration()) is_paused = true;
  }

  /** Jumps, and calls back for the newest message of every channel and for the `window` seconds
   * before. */
  void seek(double time, double window, const LogFile::Visitor& visit) {
    time_ = std::clamp(time, 0.0, log_.duration());
    log_.read_latest(time_ - window, visit);
    log_.read(time_ - window, time_, visit);
  }

  double time() const { return time_; }
  double duration() const { return log_.duration(); }

  bool is_paused = false;
  /** Recorded seconds per second of wall time. */
  double speed = 1;

 private:
  LogFile log_;
  /** Before the first message, so that it is played too. */
  double time_ = -1e-9;
};

}  // namespace nao
