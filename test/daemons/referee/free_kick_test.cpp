#include "daemons/referee/free_kick.h"

#include <gmock/gmock.h>

namespace nao::referee {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::IsEmpty;

/** A kick of team 0; B1 and B2 are its opponents. The rules are those of the HSL, Laws 8 and 13 to
 * 17. */
struct FreeKickTest : testing::Test {
  FreeKickTest() {
    for (const MatchPlayer& player : players) {
      RobotSighting robot;
      robot.name = player.robot;
      robot.position = {-3, player.number};
      input.robots.push_back(robot);
    }
  }

  void put_ball(const Vector2d& place) { input.ball << place, 0.05; }

  /** Steps until something is judged, at most for a duration, s. */
  FreeKick::Judgement run(FreeKick& kick, double duration) {
    FreeKick::Judgement judgement;
    for (double time = 0; time < duration; time += 0.05) {
      judgement = kick.step(0.05, input, players, scene);
      if (!judgement.offenders.empty() || judgement.is_over) break;
    }
    return judgement;
  }

  std::vector<MatchPlayer> players{{"A1", 0, 1}, {"A2", 0, 2}, {"B1", 1, 1}, {"B2", 1, 2}};
  SceneFile scene = SceneFile::find("hsl_small");
  RefereeInput input;
};

TEST_F(FreeKickTest, AnOpponentThatStaysNearTheBallIsAnOffenderAfterFiveSeconds) {
  put_ball({1, 3});
  FreeKick kick(KickKind::kKickIn, 0, {1, 3});
  input.robots[0].position = {1, 2.8};
  input.robots[2].position = {1, 2.5};
  input.robots[3].position = {1, 2.1};
  EXPECT_THAT(run(kick, 4.9).offenders, IsEmpty());
  EXPECT_THAT(run(kick, 0.3).offenders, ElementsAre("B1"));
}

TEST_F(FreeKickTest, AnOpponentThatGoesAwayIsNone) {
  put_ball({1, 3});
  FreeKick kick(KickKind::kKickIn, 0, {1, 3});
  input.robots[2].position = {1, 2.5};
  run(kick, 4);
  input.robots[2].position = {1, 2};
  run(kick, 1);
  input.robots[2].position = {1, 2.5};
  EXPECT_THAT(run(kick, 4).offenders, IsEmpty());
}

TEST_F(FreeKickTest, AGoalKickHasThePenaltyAreaForItself) {
  // Team 1 kicks before the goal at positive x, which team 0 attacks.
  put_ball({3.5, 1.5});
  FreeKick kick(KickKind::kGoalKick, 1, {3.5, 1.5});
  input.robots[2].position = {3.4, 1.4};
  input.robots[0].position = {2.8, -1.5};
  input.robots[1].position = {2.3, 1.5};
  EXPECT_THAT(run(kick, 6).offenders, ElementsAre("A1"));
}

TEST_F(FreeKickTest, AKeeperMayStayOnItsLine) {
  put_ball({4.5, 0.9});
  FreeKick kick(KickKind::kCornerKick, 0, {4.5, 0.9});
  input.robots[2].position = {4.45, 0.6};
  EXPECT_THAT(run(kick, 10).offenders, IsEmpty());
}

TEST_F(FreeKickTest, AnOpponentThatTouchesTheBallIsAnOffenderAndTheKickIsRetaken) {
  put_ball({1, 3});
  FreeKick kick(KickKind::kKickIn, 0, {1, 3});
  input.robots[3].touches_ball = true;
  put_ball({1.5, 2.5});
  const FreeKick::Judgement judgement = run(kick, 0.04);
  EXPECT_THAT(judgement.offenders, ElementsAre("B2"));
  EXPECT_TRUE(judgement.is_retaken);
  EXPECT_FALSE(judgement.is_over);
}

TEST_F(FreeKickTest, TheBallIsFreeWhenTheTeamHasMovedItOrItsTimeIsOver) {
  put_ball({1, 3});
  FreeKick kick(KickKind::kKickIn, 0, {1, 3});
  EXPECT_FALSE(run(kick, 44.9).is_over);
  EXPECT_TRUE(run(kick, 0.3).is_over);
  put_ball({0, 0});
  FreeKick kick_off(KickKind::kKickOff, 0, {0, 0});
  EXPECT_FALSE(run(kick_off, 9.9).is_over);
  EXPECT_TRUE(run(kick_off, 0.3).is_over);
  FreeKick moved(KickKind::kKickOff, 0, {0, 0});
  put_ball({0.06, 0});
  EXPECT_TRUE(run(moved, 0.04).is_over);
}

TEST_F(FreeKickTest, ARobotThatGetsUpOrHasAPenaltyIsNoOffender) {
  put_ball({1, 3});
  FreeKick kick(KickKind::kKickIn, 0, {1, 3});
  input.robots[2].position = {1, 2.5};
  input.robots[2].is_upright = false;
  input.robots[3].position = {1.1, 2.5};
  players[3].penalty = Penalty::kOperator;
  EXPECT_THAT(run(kick, 10).offenders, IsEmpty());
}

}  // namespace
}  // namespace nao::referee
