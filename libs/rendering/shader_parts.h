#pragma once

#include <string>

/** Parts that several shaders share. */
namespace nao::shaders {

inline constexpr const char* kHeader = "#version 330 core\n";

/** Beginning of fragment shaders of lit surfaces: the version, and the functions direct_fraction(),
 * lit() and encoded(). @param with_shadow  Whether the light is looked up in the shadow map. */
std::string lit_header(bool with_shadow);

}  // namespace nao::shaders
