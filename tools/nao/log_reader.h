#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nao {

/** One recorded message. */
struct LogEvent {
  int64_t number = 0;
  /** When it was received, microseconds since 1970. */
  int64_t wall_utime = 0;
  std::string channel;
  std::vector<uint8_t> data;
};

/** Reads a log of lcm-logger from its beginning to its end, and goes on behind damaged places,
 * where LCM's own reader ends.
 *
 * Format: LCM's documentation, "Log file format": events of a 28-byte big-endian header (sync word
 * 0xEDA1DA01, number, time in us, lengths of channel and data), channel name, data. */
class LogReader {
 public:
  /** @throws Error  if the file cannot be opened. */
  explicit LogReader(const std::filesystem::path& file);

  /** @return nullopt at the end. An event that is cut off there is left out. */
  std::optional<LogEvent> next();

  /** Bytes so far that belong to no whole event. */
  int64_t num_bytes_skipped() const { return num_bytes_skipped_; }

 private:
  std::optional<LogEvent> read_event();

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Closer> file_;
  int64_t size_ = 0;
  /** Where the next event should begin. */
  int64_t offset_ = 0;
  int64_t num_bytes_skipped_ = 0;
};

/** An event as it stands in a log. */
std::vector<uint8_t> encode_log_event(const LogEvent& event);

}  // namespace nao
