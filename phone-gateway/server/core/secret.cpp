#include "phone-gateway/server/core/secret.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "common/error.h"

namespace nao::gateway {

// Takes the same time wherever the first difference is: otherwise the time of the answer would
// reveal the token byte by byte.
bool equals_secret(const std::string& received, const std::string& secret) {
  unsigned difference = received.size() == secret.size() ? 0 : 1;
  for (size_t i = 0; i < received.size(); ++i) {
    const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
    difference |= static_cast<unsigned char>(received[i]) ^ static_cast<unsigned char>(expected);
  }
  return difference == 0;
}

std::string make_token() {
  // 32 characters, 5 bits each: without 0, 1, l and o.
  static constexpr char kAlphabet[] = "abcdefghijkmnpqrstuvwxyz23456789";
  static_assert(sizeof kAlphabet == 33);
  std::array<unsigned char, 8> random{};
  if (getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
    throw Error(std::string("cannot make a token: getrandom: ") + std::strerror(errno));
  }
  std::string token;
  // 256 is a multiple of 32: all characters are equally likely.
  for (const unsigned char byte : random) token.push_back(kAlphabet[byte % 32]);
  return token.insert(4, "-");
}

std::string plain_token(const std::string& token) {
  std::string plain;
  for (const char c : token) {
    if (c == '-' || c == ' ') continue;
    plain.push_back('A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  }
  return plain;
}

}  // namespace nao::gateway
