#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace nao {

/** A character of a text in UTF-8. */
struct Utf8Character {
  char32_t code = 0;
  size_t num_bytes = 0;
};

/** @return The character that begins at a byte of a text; nothing if none does: the bytes are cut
 *   off, longer than necessary, a surrogate, or above U+10FFFF (RFC 3629, section 3). */
std::optional<Utf8Character> read_utf8(std::string_view text, size_t position);

}  // namespace nao
