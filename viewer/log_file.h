#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/log_reader.h"

namespace nao::viewer {

/** A log of lcm-logger with random access. Only an index is kept in memory. */
class LogFile {
 public:
  /** Receives a message and its time of reception, s since the first message of the log. */
  using Visitor = std::function<void(const std::string& channel, const std::vector<uint8_t>& data,
                                     double time)>;

  /** Reads the index; damaged parts of the file are skipped.
   * @throws Error  if the file cannot be opened or contains no message. */
  explicit LogFile(const std::filesystem::path& file);

  /** Duration of the recording, s. */
  double duration() const;
  size_t num_events() const { return index_.size(); }

  /** Visits every message with from < time <= to, in order. */
  void read(double from, double to, const Visitor& visit);

  /** Visits, for each channel, its last message up to `time`; oldest first. */
  void read_latest(double time, const Visitor& visit);

 private:
  /** A LogEntry in few bytes, since an hour of recording has about a million messages. */
  struct Entry {
    double time;
    int64_t offset;
    uint32_t size;
    /** Index into channels_. */
    uint32_t channel;
  };

  void visit_entry(const Entry& entry, const Visitor& visit);
  /** Index of the first entry after `time`. */
  size_t first_after(double time) const;

  LogReader reader_;
  std::vector<std::string> channels_;
  std::vector<Entry> index_;
};

}  // namespace nao::viewer
