#pragma once

#include <string>
#include <vector>

namespace nao::speaker {

/** More than 200 texts that nobody says to a robot with good intentions, or that few programs
 * expect: emoji, right-to-left, markup, shell syntax, control characters, bytes that are not text.
 */
std::vector<std::string> odd_texts();

}  // namespace nao::speaker
