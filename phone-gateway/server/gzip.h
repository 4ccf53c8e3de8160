#pragma once

#include <string>
#include <string_view>

namespace nao {

/** The bytes as a gzip file. @throws Error  if zlib fails, which it does for want of memory only.
 */
std::string gzip(std::string_view bytes);

}  // namespace nao
