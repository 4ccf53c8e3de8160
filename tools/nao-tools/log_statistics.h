#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "common/log_reader.h"

namespace nao {

/** Statistics of one channel of a log. */
struct LoggedChannel {
  /** Type of the last message; "?" if it is unknown. */
  std::string type = "?";
  int64_t num_messages = 0;
  int64_t num_bytes = 0;
  /** Messages of an unknown type, and messages that do not decode. */
  int64_t num_undecodable = 0;
  /** Wall clock, microseconds since 1970. */
  int64_t first_utime = 0;
  int64_t last_utime = 0;
  /** Maximum time between two messages, s. */
  double longest_gap = 0;
  /** Control ticks; empty if the messages have none. */
  std::set<int64_t> ticks;

  /** Mean rate between the first and the last message, Hz; 0 for a single message. */
  double rate() const;
  /** Number of ticks between the first and the last one that the log lacks: at rest they are not
   * sent, else their messages were lost. */
  int64_t num_missing_ticks() const;
};

/** Counts the messages of each channel of a log. */
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
