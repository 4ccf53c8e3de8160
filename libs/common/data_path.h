#pragma once

#include <filesystem>

namespace nao {

/** Folder with the files that programs read (robots/, web/): NAO_REMOTE_DATA if set, else
 * ../share/nao-remote beside the running program, in the build tree as after installation.
 * @throws ConfigError  if the folder does not exist. */
std::filesystem::path data_path();

/** Folder of files that programs keep between runs: XDG_STATE_HOME/nao-remote, usually
 * ~/.local/state/nao-remote. @throws ConfigError  if neither XDG_STATE_HOME nor HOME is set. */
std::filesystem::path state_path();

}  // namespace nao
