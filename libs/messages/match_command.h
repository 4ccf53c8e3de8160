#pragma once

#include <array>
#include <naolcm/match_command_t.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "messages/reason.h"

namespace nao {

/** What an operator overrules; the values are those of match_command_t::OPERATION_*. */
enum class MatchOperation {
  kStart,
  kKickOff,
  kGoal,
  kTakeBackGoal,
  kPenalize,
  kRelease,
  kEndHalf,
  kFinish,
  kNewMatch,
};

/** Names for users, in the order of the enumeration. */
inline constexpr std::array<std::string_view, 9> kMatchOperationNames = {
    "start",   "kick-off", "goal",   "take-back-goal", "penalize",
    "release", "end-half", "finish", "new-match"};

/** @return Of kMatchOperationNames; "unknown" for a value outside the enumeration. */
std::string_view to_string(MatchOperation operation);

/** Overrules the referee; match_command_t documents every field. */
struct MatchCommand {
  MatchOperation operation = MatchOperation::kStart;
  int team = 0;
  std::string robot{};
};

/** Whether an operation is about a team, and about a robot. */
bool needs_team(MatchOperation operation);
bool needs_robot(MatchOperation operation);

/** Checks every field but the robot's name.
 * @return Nothing, or the fault: "match-operation-unknown" or "match-team-unknown". */
[[nodiscard]] std::optional<Reason> check(const MatchCommand& command);

MatchCommand to_match_command(const naolcm::match_command_t& message);

/** The message without time, source and number. */
naolcm::match_command_t to_message(const MatchCommand& command);

}  // namespace nao
