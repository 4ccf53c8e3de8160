#include "daemons/play/match_view.h"

#include <gtest/gtest.h>

namespace nao::play {
namespace {

using Eigen::Vector2d;

MatchState match_of_three() {
  MatchState state;
  state.phase = MatchPhase::kPlaying;
  state.kickoff_team = 1;
  state.event = {3, MatchEventKind::kKickOff, 1, "", 95};
  state.players = {{"A1", 0, 1}, {"A2", 0, 2}, {"A3", 0, 3}, {"B1", 1, 1}};
  for (MatchPlayer& player : state.players) player.is_autonomous = true;
  return state;
}

TEST(MatchView, IsThatOfTheRobotsTeam) {
  std::map<std::string, TeamObservation> seen;
  seen["A2"] = {99.5, Vector2d(1, 1), Vector2d(2, 2)};
  seen["A3"] = {90, Vector2d(0, 0), {}};
  const auto view = view_match(match_of_three(), "A1", 100, seen);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->phase, MatchPhase::kPlaying);
  EXPECT_EQ(view->number, 1);
  EXPECT_EQ(view->team_size, 3);
  EXPECT_FALSE(view->kicks_off);
  EXPECT_NEAR(view->since_kick_off, 5, 1e-9);
  ASSERT_EQ(view->teammates.size(), 2u);
  EXPECT_TRUE(view->teammates[0].seen.position);
  // Too long ago.
  EXPECT_FALSE(view->teammates[1].seen.position);
  EXPECT_FALSE(view_match(match_of_three(), "C1", 100, seen));
  EXPECT_TRUE(view_match(match_of_three(), "B1", 100, seen)->kicks_off);
}

TEST(MatchView, TellsThatTheBallIsOutForAWhile) {
  MatchState state = match_of_three();
  state.event = {7, MatchEventKind::kBallOut, 1, "", 99};
  EXPECT_NEAR(view_match(state, "A1", 100, {})->ball_out->age, 1, 1e-9);
  EXPECT_FALSE(view_match(state, "A1", 100, {})->ball_out->is_own);
  EXPECT_TRUE(view_match(state, "B1", 100, {})->ball_out->is_own);
  EXPECT_FALSE(view_match(state, "A1", 145, {})->ball_out);
}

TEST(MatchView, TheBallIsTheOwnOneOrTheNewestOfATeammate) {
  MatchView view;
  view.teammates = {{2, true, false, {99, Vector2d(0, 0), Vector2d(1, 0)}},
                    {3, true, false, {99.5, Vector2d(0, 0), Vector2d(2, 0)}}};
  EXPECT_EQ(find_team_ball(view, Vector2d(3, 0), 100)->x(), 3);
  EXPECT_EQ(find_team_ball(view, {}, 100)->x(), 2);
  EXPECT_FALSE(find_team_ball(view, {}, 110));
}

struct RoleTest : testing::Test {
  PlayRole role_of(int number, const Vector2d& position, PlayRole present = PlayRole::kNone) {
    MatchView view;
    view.number = number;
    view.team_size = 3;
    for (const auto& [other, place] : places) {
      if (other == number) continue;
      Teammate mate;
      mate.number = other;
      mate.is_playing = !is_out || other != *is_out;
      mate.seen.position = place;
      view.teammates.push_back(mate);
    }
    return choose_role(view, position, ball, present);
  }
  std::map<int, Vector2d> places{{1, {0, 0}}, {2, {-2, 1}}, {3, {-4, 0}}};
  std::optional<int> is_out;
  std::optional<Vector2d> ball = Vector2d(1, 0);
};

TEST_F(RoleTest, TheNearestIsTheStrikerAndTheHighestNumberKeepsTheGoal) {
  EXPECT_EQ(role_of(1, places[1]), PlayRole::kStriker);
  EXPECT_EQ(role_of(2, places[2]), PlayRole::kSupporter);
  EXPECT_EQ(role_of(3, places[3]), PlayRole::kKeeper);
  ball = Vector2d(-2, 0);
  EXPECT_EQ(role_of(1, places[1]), PlayRole::kSupporter);
  EXPECT_EQ(role_of(2, places[2]), PlayRole::kStriker);
}

TEST_F(RoleTest, ExactlyOneIsTheStriker) {
  for (double x = -4; x < 4; x += 0.37) {
    ball = Vector2d(x, 0.3);
    EXPECT_NE(role_of(1, places[1]) == PlayRole::kStriker,
              role_of(2, places[2]) == PlayRole::kStriker);
  }
  // Nobody knows where the ball is.
  ball.reset();
  EXPECT_EQ(role_of(1, places[1]), PlayRole::kStriker);
  EXPECT_EQ(role_of(2, places[2]), PlayRole::kSupporter);
}

TEST_F(RoleTest, TheStrikerStaysItWhereTheDistancesDifferLittle) {
  ball = Vector2d(-1, 0.4);
  EXPECT_EQ(role_of(1, {0.2, 0}), PlayRole::kSupporter);
  EXPECT_EQ(role_of(1, {0.2, 0}, PlayRole::kStriker), PlayRole::kStriker);
}

TEST_F(RoleTest, OthersStepInForOneThatDoesNotPlay) {
  is_out = 3;
  EXPECT_EQ(role_of(2, places[2]), PlayRole::kKeeper);
  EXPECT_EQ(role_of(1, places[1]), PlayRole::kStriker);
  MatchView alone;
  Teammate out;
  out.is_penalised = true;
  alone.number = 2;
  alone.team_size = 2;
  alone.teammates = {out};
  EXPECT_EQ(choose_role(alone, {-4, 0}, {}, PlayRole::kKeeper), PlayRole::kStriker);
  EXPECT_EQ(choose_role(alone, {0, 0}, {}, PlayRole::kNone), PlayRole::kStriker);
}

}  // namespace
}  // namespace nao::play
