#include "phone-gateway/server/core/client_name.h"

namespace nao::gateway {
namespace {

/** As remote.proto says. */
constexpr int kMaxCharacters = 40;

bool is_control(unsigned char c) {
  return c < ' ' || c == 0x7f;
}

/** True for the second and later bytes of a character in UTF-8. */
bool is_continuation(unsigned char c) {
  return (c & 0xc0) == 0x80;
}

}  // namespace

std::string clean_client_name(const std::string& requested) {
  std::string name;
  int num_characters = 0;
  for (const char c : requested) {
    if (is_control(static_cast<unsigned char>(c))) continue;
    // Counted in characters, not bytes; the limit never cuts a character in two.
    if (!is_continuation(static_cast<unsigned char>(c)) && ++num_characters > kMaxCharacters) break;
    name.push_back(c);
  }
  const size_t first = name.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return name.substr(first, name.find_last_not_of(' ') - first + 1);
}

}  // namespace nao::gateway
