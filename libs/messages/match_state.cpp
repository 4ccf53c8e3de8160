#include "messages/match_state.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "messages/enum_names.h"

namespace nao {
namespace {

using naolcm::match_state_t;
using naolcm::player_t;

static_assert(match_state_t::PHASE_FINISHED == static_cast<int>(MatchPhase::kFinished));
static_assert(match_state_t::EVENT_GOAL == static_cast<int>(MatchEventKind::kGoal));
static_assert(match_state_t::EVENT_BALL_FREE == static_cast<int>(MatchEventKind::kBallFree));
static_assert(player_t::PENALTY_OPERATOR == static_cast<int>(Penalty::kOperator));
static_assert(player_t::ROLE_KEEPER == static_cast<int>(PlayRole::kKeeper));

/** @throws MessageError  unless least <= value <= greatest. */
template <class Value>
Value within(Value value, Value least, Value greatest, const char* field) {
  if (!(value >= least && value <= greatest)) {
    throw MessageError(std::string(field) + " is " + std::to_string(value));
  }
  return value;
}

template <class Enum>
Enum read_enum(int8_t value, Enum last, const char* field) {
  return static_cast<Enum>(within<int>(value, 0, static_cast<int>(last), field));
}

MatchPlayer read_player(const player_t& message) {
  MatchPlayer player;
  player.robot = message.robot;
  player.team = within<int>(message.team, 0, 1, "the team of a player");
  player.number = within<int>(message.number, 1, 127, "the number of a player");
  player.role = read_enum(message.role, PlayRole::kKeeper, "the role of a player");
  player.is_autonomous = message.is_autonomous != 0;
  player.penalty = read_enum(message.penalty, Penalty::kOperator, "the penalty of a player");
  player.penalty_left = message.penalty_left;
  return player;
}

player_t write_player(const MatchPlayer& player) {
  player_t message;
  message.robot = player.robot;
  message.team = static_cast<int8_t>(player.team);
  message.number = static_cast<int8_t>(player.number);
  message.role = static_cast<int8_t>(player.role);
  message.is_autonomous = player.is_autonomous ? 1 : 0;
  message.penalty = static_cast<int8_t>(player.penalty);
  message.penalty_left = player.penalty_left;
  return message;
}

}  // namespace

std::string_view to_string(MatchPhase phase) {
  return name_in(kMatchPhaseNames, phase);
}

std::string_view to_string(MatchEventKind kind) {
  return name_in(kMatchEventNames, kind);
}

std::string_view to_string(Penalty penalty) {
  return name_in(kPenaltyNames, penalty);
}

MatchState to_match_state(const match_state_t& message) {
  MatchState state;
  state.id = message.match_id;
  state.phase = read_enum(message.phase, MatchPhase::kFinished, "the phase of the match");
  state.half = within<int>(message.half, 1, 2, "the half of the match");
  state.time_left = within(message.time_left, 0.0, 1e6, "the time left");
  state.kickoff_team = within<int>(message.kickoff_team, 0, 1, "the team that kicks off");
  for (size_t team = 0; team < 2; ++team) {
    state.score[team] = within<int>(message.score[team], 0, 10000, "the score");
  }
  for (const player_t& player : message.players) state.players.push_back(read_player(player));
  state.event.id = message.event_id;
  state.event.kind = read_enum(message.event, MatchEventKind::kBallFree, "the event of the match");
  state.event.team = within<int>(message.event_team, -1, 1, "the team of an event");
  state.event.robot = message.event_robot;
  state.event.time = 1e-6 * static_cast<double>(message.event_utime);
  return state;
}

match_state_t to_message(const MatchState& state, int64_t utime, int64_t sequence) {
  match_state_t message;
  message.utime = utime;
  message.match_id = state.id;
  message.sequence = sequence;
  message.phase = static_cast<int8_t>(state.phase);
  message.half = static_cast<int8_t>(state.half);
  message.time_left = state.time_left;
  message.kickoff_team = static_cast<int8_t>(state.kickoff_team);
  for (size_t team = 0; team < 2; ++team) message.score[team] = state.score[team];
  for (const MatchPlayer& player : state.players) message.players.push_back(write_player(player));
  message.num_players = static_cast<int32_t>(message.players.size());
  message.event_id = state.event.id;
  message.event = static_cast<int8_t>(state.event.kind);
  message.event_team = static_cast<int8_t>(state.event.team);
  message.event_robot = state.event.robot;
  message.event_utime = std::llround(1e6 * state.event.time);
  return message;
}

const MatchPlayer* find_player(const MatchState& state, std::string_view robot) {
  const auto found = std::find_if(state.players.begin(), state.players.end(),
                                  [&](const MatchPlayer& player) { return player.robot == robot; });
  return found != state.players.end() ? &*found : nullptr;
}

}  // namespace nao
