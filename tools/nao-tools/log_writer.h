#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

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

  /** Appends an event; its number becomes its index in the recording.
   * @throws Error  if it cannot be written: a full disk. */
  void write(LogEvent event);

  /** Flushes the buffer to the operating system: a reader sees the events, and a killed process
   * does not lose them.
   * @throws Error  as write(). */
  void flush();

  int64_t num_events() const { return num_events_; }

 private:
  void open_next();

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  LogSplit split_;
  std::unique_ptr<std::FILE, Closer> file_;
  int64_t num_bytes_ = 0;
  int64_t num_events_ = 0;
  int num_files_ = 0;
};

}  // namespace nao
