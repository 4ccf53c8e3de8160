#include "phone-gateway/secure_channel/hexadecimal.h"

#include <sys/random.h>

#include <cerrno>
#include <cstring>

#include "common/error.h"

namespace nao {

std::string to_hex(std::string_view bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string digits;
  for (const char byte : bytes) {
    digits.push_back(kDigits[static_cast<unsigned char>(byte) >> 4]);
    digits.push_back(kDigits[byte & 15]);
  }
  return digits;
}

std::optional<std::string> from_hex(std::string_view digits, size_t num_bytes) {
  if (digits.size() != 2 * num_bytes) return std::nullopt;
  std::string bytes(num_bytes, '\0');
  for (size_t i = 0; i < digits.size(); ++i) {
    const char c = digits[i];
    const bool is_letter = 'a' <= c && c <= 'f';
    if (!is_letter && !('0' <= c && c <= '9')) return std::nullopt;
    const int value = is_letter ? c - 'a' + 10 : c - '0';
    bytes[i / 2] = static_cast<char>(bytes[i / 2] << 4 | value);
  }
  return bytes;
}

std::string random_bytes(size_t num_bytes) {
  std::string bytes(num_bytes, '\0');
  if (getrandom(bytes.data(), num_bytes, 0) != static_cast<ssize_t>(num_bytes)) {
    throw Error(std::string("no random bytes: getrandom: ") + std::strerror(errno));
  }
  return bytes;
}

}  // namespace nao
