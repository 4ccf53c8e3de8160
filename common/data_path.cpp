#include "common/data_path.h"

#include <cstdlib>

#include "common/error.h"

namespace nao {

std::filesystem::path data_path() {
  const char* override_path = std::getenv("NAO_REMOTE_DATA");
  std::filesystem::path path =
      override_path != nullptr
          ? std::filesystem::path(override_path)
          : std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() / "share" /
                "nao-remote";
  if (!std::filesystem::is_directory(path)) {
    throw ConfigError(
        "data folder " + path.string() +
        " does not exist: build or install the whole project, or set NAO_REMOTE_DATA");
  }
  return path;
}

}  // namespace nao
