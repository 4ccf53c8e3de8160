#pragma once

#include <string>
#include <vector>

#include "daemons/motion/walk/gait.h"

namespace nao::tool {

/** Replaces values in the text of a gait file; ranges, order and comments stay as they are,
 * except that a comment no longer says that nobody has tuned the gait.
 * @param text        Text of a file that Gait::load() accepts, with one parameter in a line.
 * @param parameters  Parameters whose values are replaced by those of `gait`.
 * @throws Error  if the text has no line "  KEY: {value: ..." in the group of one of them. */
std::string with_gait_values(const std::string& text, const motion::Gait& gait,
                             const std::vector<motion::Gait::Parameter>& parameters);

}  // namespace nao::tool
