#pragma once

#include <string>

namespace nao {

/** Compares in a time that depends on the lengths only, so that a secret cannot be guessed piece by
 * piece from how long a refusal takes. */
bool equals_secret(const std::string& said, const std::string& secret);

/** A new token: 16 letters and digits that nobody mixes up, 80 bits from the system's source. */
std::string make_token();

}  // namespace nao
