#pragma once

#include "messages/command.h"
#include "messages/mode.h"

namespace nao::motion {

/** What happens to a command in a mode. */
enum class Acceptance {
  kRefuse,
  /** It replaces what runs, at the next point where that is safe. */
  kReplace,
};

/** The one table that says which command is accepted in which mode. */
Acceptance acceptance_of(CommandKind kind, Mode mode);

/** Why commands are refused in a mode, as a sentence for a person. */
const char* refusal_in(Mode mode);

}  // namespace nao::motion
