#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "common/log_reader.h"

namespace nao {

/** What a log holds of one channel. */
struct LoggedChannel {
  /** Of the last message; "?" if it is none of the project's. */
  std::string type = "?";
  int64_t num_messages = 0;
  int64_t num_bytes = 0;
  /** Messages of no known type, or that do not decode as theirs. */
  int64_t num_undecodable = 0;
  /** Wall clock, microseconds since 1970. */
  int64_t first_utime = 0;
  int64_t last_utime = 0;
  /** Longest time between two messages, s. */
  double longest_gap = 0;
  /** Control ticks; empty if the messages have none. */
  std::set<int64_t> ticks;

  /** Messages a second between the first and the last one; 0 if there is but one. */
  double rate() const;
  /** Ticks between the first and the last one that are not in the log: messages that were lost. */
  int64_t num_missing_ticks() const;
};

/** Counts the messages of a log, channel by channel. */
class LogStatistics {
 public:
  void add(const LogEvent& event);

  const std::map<std::string, LoggedChannel>& channels() const { return channels_; }
  int64_t num_messages() const;
  /** From the first message to the last, s. */
  double duration() const;

  std::string to_text() const;
  std::string to_json() const;

 private:
  std::map<std::string, LoggedChannel> channels_;
  int64_t first_utime_ = 0;
  int64_t last_utime_ = 0;
};

}  // namespace nao
