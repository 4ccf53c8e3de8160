#include "common/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <streambuf>
#include <system_error>
#include <utility>

#include "common/error.h"

namespace nao {

/** Writes blocks to a descriptor; std::ofstream would not tell why it fails. */
class OutputFile::Buffer : public std::streambuf {
 public:
  /** @param name  For errors. */
  Buffer(const std::filesystem::path& file, mode_t mode, std::string name)
      : name_(std::move(name)),
        descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode)) {
    if (descriptor_ < 0) fail();
    setp(block_.data(), block_.data() + block_.size());
  }
  ~Buffer() override {
    if (descriptor_ >= 0) close(descriptor_);
  }

  int sync() override {
    for (const char* next = pbase(); next != pptr();) {
      const ssize_t size = write(descriptor_, next, static_cast<size_t>(pptr() - next));
      if (size < 0 && errno != EINTR) fail();
      if (size > 0) next += size;
    }
    setp(block_.data(), block_.data() + block_.size());
    return 0;
  }

  void finish(bool is_on_disk) {
    sync();
    if (is_on_disk && fsync(descriptor_) != 0) fail();
    if (close(std::exchange(descriptor_, -1)) != 0) fail();
  }

  [[noreturn]] void fail() const {
    throw Error("cannot write " + name_ + ": " + std::strerror(errno));
  }

 protected:
  int overflow(int byte) override {
    sync();
    return byte == traits_type::eof() ? 0 : sputc(static_cast<char>(byte));
  }

 private:
  std::string name_;
  int descriptor_;
  std::array<char, 1 << 16> block_;
};

OutputFile::OutputFile(const std::filesystem::path& file, mode_t mode)
    : file_(file), stream_(nullptr) {
  std::error_code error;
  if (std::filesystem::is_symlink(file)) {
    file_ = std::filesystem::weakly_canonical(file, error);
    if (error) throw Error("cannot write " + file.string() + ": " + error.message());
  }
  const auto status = std::filesystem::status(file_, error);
  if (!std::filesystem::exists(status)) {
    part_ = file_;
  } else if (std::filesystem::is_regular_file(status)) {
    part_ = file_;
    mode = static_cast<mode_t>(status.permissions() & std::filesystem::perms::all) & mode;
  }
  if (!part_.empty()) {
    part_ += ".part";
    // A part that a killed program has left may have other permissions.
    std::filesystem::remove(part_, error);
  }
  buffer_ = std::make_unique<Buffer>(part_.empty() ? file_ : part_, mode, file.string());
  stream_.rdbuf(buffer_.get());
  stream_.exceptions(std::ios::badbit);
}

OutputFile::~OutputFile() {
  if (part_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputFile::finish() {
  buffer_->finish(!part_.empty());
  if (part_.empty()) return;
  if (std::rename(part_.c_str(), file_.c_str()) != 0) buffer_->fail();
  part_.clear();
  // The name, too, must outlast a power loss.
  const int folder = open(file_.has_parent_path() ? file_.parent_path().c_str() : ".",
                          O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  (void)fsync(folder);
  close(folder);
}

void replace_file(const std::filesystem::path& file, const std::string& bytes, mode_t mode) {
  OutputFile output(file, mode);
  output.stream() << bytes;
  output.finish();
}

}  // namespace nao
