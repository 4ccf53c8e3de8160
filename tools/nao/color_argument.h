#pragma once

#include <string>

#include "messages/light_command.h"

namespace nao {

/** Reads a color: "red" and other names, or "#ff8000" (red, green, blue).
 * @throws ConfigError  if it is neither; the text lists the names. */
LightColor parse_color(const std::string& text);

}  // namespace nao
