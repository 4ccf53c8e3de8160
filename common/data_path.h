#pragma once

#include <filesystem>

namespace nao {

/** Folder with the files that programs read (robots/, web/): NAO_REMOTE_DATA if set, else
 * ../share/nao-remote beside the running program, in the build tree as after installation.
 * @throws ConfigError  if the folder does not exist. */
std::filesystem::path data_path();

}  // namespace nao
