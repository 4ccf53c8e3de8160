#pragma once

#include <array>
#include <cstdint>
#include <naolcm/match_state_t.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "messages/play_command.h"

namespace nao {

/** The values are those of match_state_t::PHASE_*. */
enum class MatchPhase { kInitial, kReady, kSet, kPlaying, kFinished };

/** The values are those of match_state_t::EVENT_*. */
enum class MatchEventKind {
  kNone,
  kKickOff,
  kGoal,
  kBallOut,
  kPenalty,
  kPenaltyEnd,
  kHalfEnd,
  kMatchEnd,
  kBallFree,
};

/** The values are those of player_t::PENALTY_*. */
enum class Penalty { kNone, kLeftField, kNotGettingUp, kPushing, kOperator };

/** Names for users, in the order of the enumerations. */
inline constexpr std::array<std::string_view, 5> kMatchPhaseNames = {"initial", "ready", "set",
                                                                     "playing", "finished"};
inline constexpr std::array<std::string_view, 9> kMatchEventNames = {
    "none",        "kick-off", "goal",      "ball-out", "penalty",
    "penalty-end", "half-end", "match-end", "ball-free"};
inline constexpr std::array<std::string_view, 5> kPenaltyNames = {
    "none", "left-field", "not-getting-up", "pushing", "operator"};

std::string_view to_string(MatchPhase phase);
std::string_view to_string(MatchEventKind kind);
std::string_view to_string(Penalty penalty);

/** One robot of a match; player_t documents every field. */
struct MatchPlayer {
  std::string robot;
  int team = 0;
  int number = 1;
  PlayRole role = PlayRole::kNone;
  bool is_autonomous = false;
  Penalty penalty = Penalty::kNone;
  double penalty_left = 0;
};

/** Something that happened in a match. */
struct MatchEvent {
  /** Counted up from 1 in a match; 0: none yet. */
  int64_t id = 0;
  MatchEventKind kind = MatchEventKind::kNone;
  /** -1: none. */
  int team = -1;
  std::string robot{};
  /** Robot time, s. */
  double time = 0;
};

/** State of a match; match_state_t documents every field. */
struct MatchState {
  int64_t id = 0;
  MatchPhase phase = MatchPhase::kInitial;
  int half = 1;
  double time_left = 0;
  int kickoff_team = 0;
  std::array<int, 2> score{};
  std::vector<MatchPlayer> players;
  MatchEvent event;
};

/** @throws Error  if a value is outside its range. */
MatchState to_match_state(const naolcm::match_state_t& message);

/** @param utime  Robot time, microseconds. @param sequence  Counted up with every message. */
naolcm::match_state_t to_message(const MatchState& state, int64_t utime, int64_t sequence);

/** The player of a robot; nullptr if it does not take part. */
const MatchPlayer* find_player(const MatchState& state, std::string_view robot);

}  // namespace nao
