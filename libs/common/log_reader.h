#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/log_clock.h"

namespace nao {

/** One recorded message. */
struct LogEvent {
  int64_t number = 0;
  /** When it was received, microseconds since 1970, without steps of the clock (LogClock). */
  int64_t wall_utime = 0;
  std::string channel;
  std::vector<uint8_t> data;
};

/** Position of a recorded message in its log. */
struct LogEntry {
  int64_t number = 0;
  /** As in LogEvent. */
  int64_t wall_utime = 0;
  std::string channel;
  /** Offset of the message from the file's beginning and its length, bytes. */
  int64_t offset = 0;
  uint32_t size = 0;
};

/** Reads a log of lcm-logger sequentially. After damaged bytes it resumes at the next event, where
 * LCM's own reader ends. It does not buffer the log in memory.
 *
 * Format: LCM's documentation, "Log file format": events of a 28-byte big-endian header (sync word
 * 0xEDA1DA01, number, time in us, lengths of channel and data), channel name, data. */
class LogReader {
 public:
  /** @throws Error  if the file cannot be opened. */
  explicit LogReader(const std::filesystem::path& file);

  /** @return nullopt at the end. A truncated last event is skipped. */
  std::optional<LogEvent> next();

  /** As next(), without reading the message's content. */
  std::optional<LogEntry> next_entry();

  /** The message of an entry, by its offset and size; empty if the file has shrunk since. */
  std::vector<uint8_t> data(int64_t offset, uint32_t size);

  /** Number of bytes so far that belong to no complete event, and of the events that they replace:
   * those whose numbers are missing after damage. */
  int64_t num_bytes_skipped() const { return num_bytes_skipped_; }
  int64_t num_events_skipped() const { return num_events_skipped_; }
  const LogClock& clock() const { return clock_; }

 private:
  std::optional<LogEntry> read_entry();
  /** Whether an event begins here: its header is whole, and its channel's name. */
  bool is_event(int64_t offset) const;
  int64_t robot_utime(const LogEntry& entry) const;
  /** Moves to the next sync word at `begin` or later, or to the end. */
  void skip_to_sync(int64_t begin);
  void seek(int64_t offset);

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  int64_t size_ = 0;
  /** Offset at which the next event is expected. */
  int64_t offset_ = 0;
  int64_t num_bytes_skipped_ = 0;
  int64_t num_events_skipped_ = 0;
  int64_t last_number_ = -1;
  LogClock clock_;
};

/** Encodes an event in the format of a log. */
std::vector<uint8_t> encode_log_event(const LogEvent& event);

}  // namespace nao
