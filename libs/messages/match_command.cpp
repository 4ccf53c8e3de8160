#include "messages/match_command.h"

#include "messages/enum_names.h"

namespace nao {
namespace {

using naolcm::match_command_t;

static_assert(match_command_t::OPERATION_PENALIZE == static_cast<int>(MatchOperation::kPenalize));
static_assert(match_command_t::OPERATION_NEW_MATCH == static_cast<int>(MatchOperation::kNewMatch));

}  // namespace

std::string_view to_string(MatchOperation operation) {
  return name_in(kMatchOperationNames, operation);
}

bool needs_team(MatchOperation operation) {
  return operation == MatchOperation::kKickOff || operation == MatchOperation::kGoal ||
         operation == MatchOperation::kTakeBackGoal;
}

bool needs_robot(MatchOperation operation) {
  return operation == MatchOperation::kPenalize || operation == MatchOperation::kRelease;
}

std::optional<Reason> check(const MatchCommand& command) {
  const int operation = static_cast<int>(command.operation);
  if (operation < 0 || operation > static_cast<int>(MatchOperation::kNewMatch)) {
    return Reason("match-operation-unknown", {std::to_string(operation)});
  }
  if (needs_team(command.operation) && command.team != 0 && command.team != 1) {
    return Reason("match-team-unknown", {std::to_string(command.team)});
  }
  return std::nullopt;
}

MatchCommand to_match_command(const match_command_t& message) {
  return {static_cast<MatchOperation>(message.operation), message.team, message.robot};
}

match_command_t to_message(const MatchCommand& command) {
  match_command_t message{};
  message.operation = static_cast<int8_t>(command.operation);
  message.team = static_cast<int8_t>(command.team);
  message.robot = command.robot;
  return message;
}

}  // namespace nao
