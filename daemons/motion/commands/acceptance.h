#pragma once

#include <optional>

#include "messages/command.h"
#include "messages/mode.h"
#include "messages/reason.h"

namespace nao::motion {

/** Why commands of a kind are refused in a mode; nothing if they are accepted. An accepted command
 * replaces the running motion at the next point where that is safe. */
std::optional<Reason> find_mode_obstacle(CommandKind kind, Mode mode);

}  // namespace nao::motion
