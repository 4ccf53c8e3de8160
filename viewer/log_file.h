#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/log_reader.h"

namespace nao {

/** A log of lcm-logger, read from any place. Only an index is kept in memory. */
class LogFile {
 public:
  /** Sees a channel's message, and when it was received: s from the log's first message. */
  using Visitor = std::function<void(const std::string& channel, const std::vector<uint8_t>& data,
                                     double time)>;

  /** Reads the index. Damaged places are left out.
   * @throws Error  if the file cannot be opened or holds no event. */
  explicit LogFile(const std::filesystem::path& file);

  /** Length of the recording, s. */
  double duration() const;
  size_t num_events() const { return index_.size(); }

  /** Calls back for every event with from < time <= to, in order. */
  void read(double from, double to, const Visitor& visit);

  /** Calls back for the last event up to `time` on each channel, oldest first. */
  void read_latest(double time, const Visitor& visit);

 private:
  /** A LogEntry in few bytes, for an hour of recording has a million. */
  struct Place {
    double time;
    int64_t offset;
    uint32_t size;
    uint32_t channel;
  };

  void read_place(const Place& place, const Visitor& visit);
  /** Index of the first place after `time`. */
  size_t after(double time) const;

  LogReader reader_;
  std::vector<std::string> channels_;
  std::vector<Place> index_;
};

}  // namespace nao
