#include <gtest/gtest.h>

#include <cmath>

#include "common/error.h"
#include "messages/match_command.h"
#include "messages/match_state.h"

namespace nao {
namespace {

MatchState some_state() {
  MatchState state;
  state.id = 5;
  state.phase = MatchPhase::kPlaying;
  state.half = 2;
  state.time_left = 12.5;
  state.kickoff_team = 1;
  state.score = {3, 4};
  state.players = {{"NAO1", 0, 1, PlayRole::kStriker, true, Penalty::kPushing, 7},
                   {"NAO2", 1, 3, PlayRole::kKeeper, false, Penalty::kNone, 0}};
  state.event = {9, MatchEventKind::kPenalty, 0, "NAO1", 33.25};
  return state;
}

TEST(MatchState, GoesThroughItsMessage) {
  const naolcm::match_state_t message = to_message(some_state(), 123, 4);
  EXPECT_EQ(message.utime, 123);
  EXPECT_EQ(message.sequence, 4);
  const MatchState state = to_match_state(message);
  EXPECT_EQ(state.id, 5);
  EXPECT_EQ(state.phase, MatchPhase::kPlaying);
  EXPECT_EQ(state.half, 2);
  EXPECT_EQ(state.time_left, 12.5);
  EXPECT_EQ(state.kickoff_team, 1);
  EXPECT_EQ(state.score, (std::array{3, 4}));
  ASSERT_EQ(state.players.size(), 2u);
  EXPECT_EQ(state.players[0].robot, "NAO1");
  EXPECT_EQ(state.players[0].penalty, Penalty::kPushing);
  EXPECT_EQ(state.players[0].penalty_left, 7);
  EXPECT_TRUE(state.players[0].is_autonomous);
  EXPECT_EQ(state.players[1].role, PlayRole::kKeeper);
  EXPECT_EQ(state.players[1].number, 3);
  EXPECT_EQ(state.event.id, 9);
  EXPECT_EQ(state.event.kind, MatchEventKind::kPenalty);
  EXPECT_EQ(state.event.robot, "NAO1");
  EXPECT_EQ(state.event.time, 33.25);
  EXPECT_EQ(find_player(state, "NAO2"), &state.players[1]);
  EXPECT_EQ(find_player(state, "NAO9"), nullptr);
}

TEST(MatchState, ValuesOutsideTheirRangeAreErrors) {
  const naolcm::match_state_t good = to_message(some_state(), 0, 0);
  const auto fails = [&](const auto& change) {
    naolcm::match_state_t message = good;
    change(message);
    EXPECT_THROW((void)to_match_state(message), Error);
  };
  fails([](auto& message) { message.phase = 5; });
  fails([](auto& message) { message.half = 0; });
  fails([](auto& message) { message.time_left = std::nan(""); });
  fails([](auto& message) { message.kickoff_team = 2; });
  fails([](auto& message) { message.score[1] = -1; });
  fails([](auto& message) { message.players[0].team = 2; });
  fails([](auto& message) { message.players[0].number = 0; });
  fails([](auto& message) { message.players[0].role = 4; });
  fails([](auto& message) { message.players[0].penalty = -1; });
  fails([](auto& message) { message.event = 9; });
  fails([](auto& message) { message.event_team = -2; });
}

TEST(MatchCommand, GoesThroughItsMessageAndIsChecked) {
  const MatchCommand command =
      to_match_command(to_message(MatchCommand{MatchOperation::kPenalize, 1, "NAO3"}));
  EXPECT_EQ(command.operation, MatchOperation::kPenalize);
  EXPECT_EQ(command.team, 1);
  EXPECT_EQ(command.robot, "NAO3");
  EXPECT_FALSE(check(command));
  EXPECT_EQ(check({static_cast<MatchOperation>(-1)})->code, "match-operation-unknown");
  EXPECT_EQ(check({MatchOperation::kKickOff, 3})->code, "match-team-unknown");
  // Teams of operations that have none do not matter.
  EXPECT_FALSE(check({MatchOperation::kFinish, 3}));
  EXPECT_EQ(to_string(MatchOperation::kNewMatch), "new-match");
}

}  // namespace
}  // namespace nao
