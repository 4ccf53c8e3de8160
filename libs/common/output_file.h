#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

namespace nao {

/** A result file that appears whole or not at all: it is written beside its place as FILE.part,
 * and finish() flushes it to the disk and renames it. Without finish() FILE stays as it was.
 * A device or pipe is written directly. */
class OutputFile {
 public:
  /** @param mode  Permissions of a new file, before the umask.
   * @throws Error  It cannot be created. */
  explicit OutputFile(const std::filesystem::path& file, mode_t mode = 0666);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /** Throws Error with the reason, such as a full disk, as soon as a block cannot be written. */
  std::ostream& stream() { return stream_; }

  /** @throws Error  Not all could be written. */
  void finish();

 private:
  class Buffer;

  /** Where links lead to. */
  std::filesystem::path file_;
  std::filesystem::path part_;
  std::unique_ptr<Buffer> buffer_;
  std::ostream stream_;
};

/** Replaces a file as OutputFile does. @throws Error  It cannot be written. */
void replace_file(const std::filesystem::path& file, const std::string& bytes, mode_t mode = 0666);

}  // namespace nao
