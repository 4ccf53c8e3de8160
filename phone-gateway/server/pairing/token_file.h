#pragma once

#include <filesystem>
#include <string>

namespace nao::gateway {

/** Reads the pairing token from a file; a missing file is created with a new token (make_token()),
 * readable by its owner only. Phones stay paired when the gateway restarts.
 * @throws Error  if the file cannot be read or created, or its first line is empty. */
std::string token_from_file(const std::filesystem::path& path);

}  // namespace nao::gateway
