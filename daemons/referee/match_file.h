#pragma once

#include <string>

#include "messages/match_state.h"

namespace nao::referee {

/** A match as one JSON object, from which another referee can continue. */
std::string to_json(const MatchState& state);

/** @throws Error  if the text is not a match, or a value is outside its range. */
MatchState match_from_json(const std::string& text);

/** An event of a match as one line of JSON, with the score after it. */
std::string event_to_json(const MatchEvent& event, const MatchState& state);

}  // namespace nao::referee
