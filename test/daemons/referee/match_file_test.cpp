#include "daemons/referee/match_file.h"

#include <gmock/gmock.h>

#include "common/error.h"

namespace nao::referee {
namespace {

TEST(MatchFile, KeepsWhatAnotherRefereeNeeds) {
  MatchState state;
  state.id = (int64_t{1} << 53) - 1;
  state.phase = MatchPhase::kPlaying;
  state.half = 2;
  state.time_left = 123.4;
  state.kickoff_team = 1;
  state.score = {3, 2};
  state.event.id = 17;
  state.players = {{"NAO1", 0, 1, PlayRole::kNone, true, Penalty::kLeftField, 9.5}};
  const MatchState read = match_from_json(to_json(state));
  EXPECT_EQ(read.id, state.id);
  EXPECT_EQ(read.phase, state.phase);
  EXPECT_EQ(read.half, 2);
  EXPECT_EQ(read.time_left, 123.4);
  EXPECT_EQ(read.kickoff_team, 1);
  EXPECT_EQ(read.score, state.score);
  EXPECT_EQ(read.event.id, 17);
  ASSERT_EQ(read.players.size(), 1u);
  EXPECT_EQ(read.players[0].penalty, Penalty::kLeftField);
  EXPECT_EQ(read.players[0].penalty_left, 9.5);
}

TEST(MatchFile, WhatIsNoMatchIsAnError) {
  MatchState state;
  const std::string good = to_json(state);
  for (size_t length = 0; length + 2 < good.size(); length += 7) {
    EXPECT_THROW((void)match_from_json(good.substr(0, length)), Error) << length;
  }
  for (const char* text : {"[]", "{}", "null", "{\"match_id\": \"x\"}"}) {
    EXPECT_THROW((void)match_from_json(text), Error) << text;
  }
  std::string bad = good;
  bad.replace(bad.find("\"half\": 1"), 9, "\"half\": 9");
  EXPECT_THROW((void)match_from_json(bad), Error);
}

TEST(MatchFile, AnEventIsOneLine) {
  MatchState state;
  state.score = {1, 0};
  const std::string line = event_to_json({5, MatchEventKind::kGoal, 0, "", 12.5}, state);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_THAT(line, testing::HasSubstr("\"event\":\"goal\""));
  EXPECT_THAT(line, testing::HasSubstr("\"score\":[1,0]"));
  EXPECT_THAT(line, testing::HasSubstr("\"team\":0"));
}

}  // namespace
}  // namespace nao::referee
