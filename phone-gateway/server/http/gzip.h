#pragma once

#include <string>
#include <string_view>

namespace nao::gateway {

/** Compresses bytes into a gzip file. @throws Error  if zlib fails (out of memory). */
std::string gzip(std::string_view bytes);

}  // namespace nao::gateway
