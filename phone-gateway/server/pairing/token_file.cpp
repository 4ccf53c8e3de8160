#include "phone-gateway/server/pairing/token_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "common/error.h"
#include "phone-gateway/server/core/secret.h"

namespace nao::gateway {

// Reads the token of an earlier start, or creates the file, readable by its owner only.
std::string token_from_file(const std::filesystem::path& path) {
  // O_EXCL: of two programs that start at once, one creates the file.
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file >= 0) {
    std::string token = make_token();
    const std::string line = token + "\n";
    const bool is_written = write(file, line.data(), line.size()) == ssize_t(line.size());
    if (close(file) != 0 || !is_written) throw Error("cannot write " + path.string());
    return token;
  }
  if (errno != EEXIST) {
    throw Error("cannot create the token file " + path.string() + ": " + std::strerror(errno));
  }
  std::ifstream stream(path);
  std::string token;
  std::getline(stream, token);
  if (token.empty()) {
    throw Error("no token in " + path.string() +
                ": its first line must be the token; or delete it");
  }
  return token;
}

}  // namespace nao::gateway
