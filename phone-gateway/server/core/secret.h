#pragma once

#include <string>

namespace nao::gateway {

/** Compares in a time that depends on the lengths only, so that a secret cannot be guessed piece by
 * piece from the time that a refusal takes. */
bool equals_secret(const std::string& received, const std::string& secret);

/** A new random pairing token, short enough to be read and typed, such as "k7mq-3xpa": 40 bits of
 * the system's random source, in letters and digits that do not look alike.
 *
 * Why are 40 bits enough? A token is only tried over the network. With five guesses in 10 s
 * (GatewayLimits) one address needs 35,000 years in the mean; addresses without number, with 10,000
 * guesses a second together, 1.7 years of an uninterrupted attack.
 * @throws Error  if the source fails. */
std::string make_token();

/** A token as it is compared: in lower case, without hyphens and spaces. */
std::string plain_token(const std::string& token);

}  // namespace nao::gateway
