#pragma once

#include <string>
#include <vector>

#include "daemons/motion/walk/gait.h"

namespace nao {

/** A gait file's text with other values; ranges, order and comments stay as they are.
 * @param text        Of a file that Gait::load() took. @param parameters  Those to be written.
 * @throws Error  if the text has no line of the form "key: {value: ..." for one of them. */
std::string with_gait_values(const std::string& text, const motion::Gait& gait,
                             const std::vector<motion::Gait::Parameter>& parameters);

}  // namespace nao
