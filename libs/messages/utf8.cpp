#include "messages/utf8.h"

namespace nao {

std::optional<Utf8Character> read_utf8(std::string_view text, size_t position) {
  if (position >= text.size()) return std::nullopt;
  const auto first = static_cast<unsigned char>(text[position]);
  if (first < 0x80) return Utf8Character{first, 1};
  // 110xxxxx, 1110xxxx and 11110xxx begin characters of two, three and four bytes.
  const size_t num_bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() - position < num_bytes) return std::nullopt;
  char32_t code = first & (0x7fu >> num_bytes);
  for (size_t i = 1; i < num_bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[position + i]);
    if ((next & 0xc0) != 0x80) return std::nullopt;
    code = code << 6 | (next & 0x3fu);
  }
  const bool is_too_long = (num_bytes == 3 && code < 0x800) || (num_bytes == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  if (is_too_long || is_surrogate || code > 0x10ffff) return std::nullopt;
  return Utf8Character{code, num_bytes};
}

}  // namespace nao
