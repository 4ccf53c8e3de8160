#pragma once

#include <string>
#include <vector>

namespace nao::speaker {

/** More than 200 malicious texts, or texts that few programs expect: emoji, right-to-left, markup,
 * shell syntax, control characters, bytes that are not text. */
std::vector<std::string> odd_texts();

}  // namespace nao::speaker
