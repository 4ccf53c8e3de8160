#include "common/data_path.h"

#include <cstdlib>

#include "common/error.h"

namespace nao {

std::filesystem::path data_path() {
  // Installed and built programs have the same layout: bin/PROGRAM beside share/nao-remote.
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

std::filesystem::path state_path() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0') {
    return std::filesystem::path(state) / "nao-remote";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') {
    throw ConfigError(
        "neither HOME nor XDG_STATE_HOME is set, so there is no folder to keep files in; set one "
        "or "
        "name a folder on the command line");
  }
  return std::filesystem::path(home) / ".local" / "state" / "nao-remote";
}

}  // namespace nao
