#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/log_reader.h"

namespace nao {

/** Conditions for splitting a recording into several files. */
struct LogSplit {
  /** Size of a file at which the next one is opened, bytes; 0: no splitting. */
  int64_t max_bytes = 0;
  /** Number of files kept, FILE.0 being the newest. 0: all, as FILE.00, FILE.01 and so on. */
  int num_kept = 0;
};

/** Writes a log that LCM's tools and LogReader read. */
class LogWriter {
 public:
  /** @throws Error  if a file of this name exists or cannot be written. */
  LogWriter(const std::filesystem::path& file, const LogSplit& split);

  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /** Takes an event for the next flush(); its number becomes its index in the recording. While the
   * events that wait need more than 64 MB, it is lost.
   * @throws Error  The next file of a split recording cannot be opened. */
  void write(LogEvent event);

  /** Hands the events to the operating system: a reader sees them, and a killed process does not
   * lose them.
   * @throws Error  The disk is full: the file ends with a whole event, and the events wait for the
   *   next flush(). */
  void flush();

  int64_t num_events() const { return num_events_; }
  int64_t num_lost() const { return num_lost_; }

 private:
  void open_next();

  std::filesystem::path path_;
  LogSplit split_;
  int descriptor_ = -1;
  /** Whole events that are not written yet. */
  std::vector<uint8_t> waiting_;
  /** Written to the file. */
  int64_t num_bytes_ = 0;
  int64_t num_events_ = 0;
  int64_t num_lost_ = 0;
  int num_files_ = 0;
};

}  // namespace nao
