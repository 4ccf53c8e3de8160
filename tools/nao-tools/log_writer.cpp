#include "tools/nao-tools/log_writer.h"

#include <cerrno>
#include <cstring>
#include <string>

#include "common/error.h"

namespace nao {
namespace {

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
  // "x" fails if the file exists: recordings are never overwritten.
  file_.reset(std::fopen(file.c_str(), "wbx"));
  if (file_ == nullptr) throw Error("cannot write " + file.string() + ": " + std::strerror(errno));
  num_bytes_ = 0;
}

void LogWriter::write(LogEvent event) {
  if (split_.max_bytes > 0 && num_bytes_ >= split_.max_bytes) {
    flush();
    open_next();
  }
  event.number = num_events_++;
  const auto bytes = encode_log_event(event);
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    throw Error("cannot append to " + path_.string() + ": " + std::strerror(errno));
  }
  num_bytes_ += static_cast<int64_t>(bytes.size());
}

void LogWriter::flush() {
  if (std::fflush(file_.get()) != 0) {
    throw Error("cannot append to " + path_.string() + ": " + std::strerror(errno));
  }
}

}  // namespace nao
