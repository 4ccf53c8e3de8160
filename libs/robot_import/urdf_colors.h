#pragma once

#include <tinyxml.h>

#include <map>

#include "rendering/mesh.h"

namespace nao {

/** Colors of the visuals that state one, themselves or by a material's name; linear. */
std::map<const TiXmlElement*, Color> read_colors(const TiXmlElement& robot);

}  // namespace nao
