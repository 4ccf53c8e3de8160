#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace nao {

/** One recorded message. */
struct LogEvent {
  /** When lcm-logger received it: wall clock, s, from the log's first message. */
  double time = 0;
  std::string channel;
  std::vector<uint8_t> data;
};

/** A log of lcm-logger, read from any place. Only an index is kept in memory.
 *
 * Format: LCM's documentation, "Log file format": events of a 28-byte big-endian header (sync word
 * 0xEDA1DA01, number, time in us, lengths of channel and data), channel name, data. */
class LogFile {
 public:
  /** Reads the index.
   * @throws Error  if the file cannot be opened or holds no event. A broken end is left out. */
  explicit LogFile(const std::filesystem::path& file);

  /** Length of the recording, s. */
  double duration() const;
  size_t num_events() const { return index_.size(); }

  /** Calls back for every event with from < time <= to, in order. */
  void read(double from, double to, const std::function<void(const LogEvent&)>& visit) const;

  /** Calls back for the last event up to `time` on each channel, oldest first. */
  void read_latest(double time, const std::function<void(const LogEvent&)>& visit) const;

 private:
  struct Entry {
    double time;
    int64_t offset;
    uint32_t data_bytes;
    uint32_t channel;
  };

  LogEvent read_entry(const Entry& entry) const;
  /** Index of the first entry after `time`. */
  size_t after(double time) const;

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  std::vector<std::string> channels_;
  std::vector<Entry> index_;
};

}  // namespace nao
