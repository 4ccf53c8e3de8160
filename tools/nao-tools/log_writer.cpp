#include "tools/nao-tools/log_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "common/error.h"

namespace nao {
namespace {

// Chosen: a minute of all messages of a robot, images included.
constexpr size_t kMaxWaiting = 64'000'000;

std::filesystem::path numbered(const std::filesystem::path& file, int number, int num_digits) {
  std::string digits = std::to_string(number);
  while (static_cast<int>(digits.size()) < num_digits) digits.insert(0, "0");
  return file.string() + "." + digits;
}

}  // namespace

LogWriter::LogWriter(const std::filesystem::path& file, const LogSplit& split)
    : path_(file), split_(split) {
  open_next();
}

void LogWriter::open_next() {
  std::filesystem::path file = path_;
  if (split_.max_bytes > 0 && split_.num_kept > 0) {
    std::error_code ignored;
    for (int i = split_.num_kept - 1; i > 0; --i) {
      std::filesystem::rename(numbered(path_, i - 1, 1), numbered(path_, i, 1), ignored);
    }
    file = numbered(path_, 0, 1);
    std::filesystem::remove(file, ignored);
  } else if (split_.max_bytes > 0) {
    do {
      file = numbered(path_, num_files_++, 2);
    } while (std::filesystem::exists(file));
  }
  // Fails if the file exists: recordings are never overwritten.
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw Error("cannot write " + file.string() + ": " + std::strerror(errno));
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = descriptor;
  num_bytes_ = 0;
}

LogWriter::~LogWriter() {
  try {
    flush();
  } catch (const Error&) {
    // Who wants to know calls flush().
  }
  close(descriptor_);
}

void LogWriter::write(LogEvent event) {
  const auto num_bytes = num_bytes_ + static_cast<int64_t>(waiting_.size());
  if (split_.max_bytes > 0 && num_bytes >= split_.max_bytes) {
    flush();
    open_next();
  }
  if (waiting_.size() > kMaxWaiting) {
    ++num_lost_;
    return;
  }
  event.number = num_events_++;
  const auto bytes = encode_log_event(event);
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

void LogWriter::flush() {
  size_t num_written = 0;
  while (num_written < waiting_.size()) {
    const ssize_t size =
        pwrite(descriptor_, waiting_.data() + num_written, waiting_.size() - num_written,
               num_bytes_ + static_cast<int64_t>(num_written));
    if (size < 0 && errno != EINTR) {
      const std::string why = std::strerror(errno);
      (void)ftruncate(descriptor_, num_bytes_);
      throw Error("cannot append to " + path_.string() + ": " + why);
    }
    if (size > 0) num_written += static_cast<size_t>(size);
  }
  num_bytes_ += static_cast<int64_t>(num_written);
  waiting_.clear();
}

}  // namespace nao
