#pragma once

#include <string>

namespace nao::gateway {

/** Compares in a time that depends on the lengths only, so that a secret cannot be guessed piece by
 * piece from the time that a refusal takes. */
bool equals_secret(const std::string& received, const std::string& secret);

/** A new random pairing token: 16 letters and digits without those that look alike, 80 bits from
 * the system's random source. @throws Error  if the source fails. */
std::string make_token();

}  // namespace nao::gateway
