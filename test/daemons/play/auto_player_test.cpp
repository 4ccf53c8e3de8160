#include "daemons/play/auto_player.h"

#include <gmock/gmock.h>

#include "kinematics/formation.h"
#include "test/daemons/play/toy_world.h"

namespace nao::play {
namespace {

using Eigen::Vector2d;
using testing::Contains;
using testing::IsEmpty;

struct AutoPlayerTest : testing::Test {
  AutoPlayerTest() {
    world.match = MatchView{};
    world.match->phase = MatchPhase::kInitial;
    world.match->team_size = 2;
    Teammate mate;
    mate.number = 2;
    mate.is_playing = true;
    world.match->teammates = {mate};
    world.feet = {{-2, 1}, 0.5};
    world.ball = {0, 0};
    world.command(Behavior::kAuto);
  }

  void run(double duration) {
    for (double time = 0; time < duration; time += ToyWorld::kPeriod) world.step();
  }

  ToyWorld world;
};

TEST_F(AutoPlayerTest, StandsUntilTheMatchBeginsAndTakesItsPlace) {
  run(3);
  EXPECT_LT((world.feet.position - Vector2d(-2, 1)).norm(), 0.01);
  world.match->phase = MatchPhase::kReady;
  run(25);
  const Pose2 place = kick_off_place(1, 2, false, {4.5, 3});
  EXPECT_LT((world.feet.position - place.position).norm(), 0.2);
  EXPECT_LT(std::abs(world.feet.heading), 0.4);
  world.match->phase = MatchPhase::kSet;
  run(1);
  const Vector2d before = world.feet.position;
  run(3);
  EXPECT_LT((world.feet.position - before).norm(), 0.01);
  EXPECT_THAT(world.actions, IsEmpty());
}

TEST_F(AutoPlayerTest, TheStrikerScoresAndWaitsForTheNextKickOff) {
  world.feet = {{-0.4, 0}, 0};
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.match->since_kick_off = 0;
  for (int i = 0; i < 3000 && world.ball.x() < 4.6; ++i) world.step();
  EXPECT_GT(world.ball.x(), 4.5);
  EXPECT_LT(std::abs(world.ball.y()), 0.75);
  EXPECT_EQ(world.core.state().role, PlayRole::kStriker);
  world.match->phase = MatchPhase::kReady;
  run(5);
  EXPECT_TRUE(world.core.is_active());
}

TEST_F(AutoPlayerTest, LetsTheOthersKickOffFirst) {
  world.feet = {{-1.1, 0}, 0};
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = false;
  world.match->since_kick_off = 2;
  run(5);
  EXPECT_LT((world.feet.position - Vector2d(-1.1, 0)).norm(), 0.05);
  world.ball = {0.5, 0.2};
  run(5);
  EXPECT_GT((world.feet.position - Vector2d(-1.1, 0)).norm(), 0.3);
}

TEST_F(AutoPlayerTest, StandsWithAPenalty) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->penalty = Penalty::kPushing;
  run(5);
  EXPECT_LT((world.feet.position - Vector2d(-2, 1)).norm(), 0.01);
  EXPECT_EQ(world.core.state().reason.code, "match-penalty");
}

TEST_F(AutoPlayerTest, TheKeeperStaysInItsGoalAndClearsABallBeforeIt) {
  world.match->number = 2;
  world.match->teammates[0].number = 1;
  world.match->phase = MatchPhase::kPlaying;
  world.feet = {{-4, 0}, 0};
  world.ball = {-1.5, 0};
  run(10);
  EXPECT_EQ(world.core.state().role, PlayRole::kKeeper);
  EXPECT_LT(world.feet.position.x(), -3.8);
  world.ball = {-3.3, 0.1};
  run(25);
  EXPECT_GT(world.ball.x(), -2.5);
  world.ball = {1, 0};
  world.ball_velocity.setZero();
  run(20);
  EXPECT_LT(world.feet.position.x(), -3.8);
}

TEST_F(AutoPlayerTest, KicksPastARobotThatStandsBeforeTheBall) {
  world.feet = {{-0.5, 0}, 0};
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.robots = {{0.7, 0}};
  for (int i = 0; i < 1200 && world.actions.empty(); ++i) world.step();
  ASSERT_FALSE(world.actions.empty());
  EXPECT_GT(std::abs(world.feet.heading), 0.3);
}

TEST_F(AutoPlayerTest, KicksInPassingFarFromTheGoalAndStopsBeforeIt) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  // Whether the robot walks on after its command to kick.
  const auto walks_on_after_kick = [&] {
    world.actions.clear();
    for (int i = 0; i < 1200 && world.actions.empty(); ++i) world.step();
    world.commands.clear();
    world.step();
    world.step();
    world.step();
    for (const Command& command : world.commands) {
      const auto* walk = std::get_if<WalkCommand>(&command.request);
      if (walk != nullptr && walk->vx > 0) return true;
    }
    return false;
  };
  world.feet = {{-2.5, 0}, 0};
  world.ball = {-1.5, 0};
  EXPECT_TRUE(walks_on_after_kick());
  ASSERT_FALSE(world.actions.empty());
  world.feet = {{2, 0}, 0};
  world.ball = {3, 0};
  world.ball_velocity.setZero();
  for (int i = 0; i < 60; ++i) world.step();
  EXPECT_FALSE(walks_on_after_kick());
  EXPECT_FALSE(world.actions.empty());
}

TEST_F(AutoPlayerTest, CarriesABallThatNobodyContestsBeforeItShoots) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.feet = {{0.5, 0}, 0};
  world.ball = {1.5, 0};
  const auto comes_to_ball = [&] {
    world.actions.clear();
    world.least_distance = 10;
    for (int i = 0; i < 400 && world.actions.empty() && world.least_distance > 0.12; ++i) {
      world.step();
    }
    return world.least_distance < 0.12;
  };
  // Its feet touch the ball: it walks on with it.
  EXPECT_TRUE(comes_to_ball());
  EXPECT_TRUE(world.actions.empty());
  // Another robot at the ball: it kicks at once.
  world.feet = {{0.5, 0}, 0};
  world.robots = {{1.6, 0.9}};
  EXPECT_FALSE(comes_to_ball());
  EXPECT_FALSE(world.actions.empty());
  // Near the goal it shoots.
  world.feet = {{2.0, 0}, 0};
  world.ball = {2.9, 0};
  world.robots.clear();
  for (int i = 0; i < 60; ++i) world.step();
  EXPECT_FALSE(comes_to_ball());
  EXPECT_FALSE(world.actions.empty());
}

TEST_F(AutoPlayerTest, ShootsBesideAKeeperThatItDoesNotSee) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.feet = {{2.0, 0}, 0};
  world.ball = {2.8, 0};
  for (int i = 0; i < 1200 && world.actions.empty(); ++i) world.step();
  ASSERT_FALSE(world.actions.empty());
  // Where the shot passes the goal line: between the post and half a standing keeper.
  EXPECT_GT(std::abs(1.7 * std::tan(world.feet.heading)), 0.25);
  EXPECT_LT(std::abs(1.7 * std::tan(world.feet.heading)), 0.75);
}

TEST_F(AutoPlayerTest, KeepsItsAimOnceItHasStoppedForAShot) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.feet = {{2.0, 0}, 0};
  world.ball = {2.8, 0};
  const auto has_stopped = [&] {
    const WalkCommand& walk = world.walk;
    return (world.feet.position - world.ball).norm() < 0.25 && walk.vx == 0 && walk.vy == 0 &&
           walk.wz == 0;
  };
  for (int i = 0; i < 1200 && !has_stopped(); ++i) world.step();
  ASSERT_TRUE(has_stopped());
  // Now the keeper is seen, on the side at which the shot goes: the other one would be wider.
  world.robots = {{4.0, std::copysign(0.3, world.feet.heading)}};
  const double heading = world.feet.heading;
  for (int i = 0; i < 40 && world.actions.empty(); ++i) world.step();
  EXPECT_FALSE(world.actions.empty());
  EXPECT_NEAR(world.feet.heading, heading, 0.05);
}

TEST_F(AutoPlayerTest, GoesToABallThatOnlyATeammateSees) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.is_ball_visible = false;
  world.feet = {{-3, -1}, 1.5};
  world.ball = {2, 1};
  for (int i = 0; i < 200; ++i) {
    world.match->teammates[0].seen = {world.time, Vector2d(-4, 0), world.ball};
    world.step();
  }
  EXPECT_LT((world.feet.position - world.ball).norm(), 4);
  EXPECT_EQ(world.core.state().reason.code, "ball-not-in-sight");
}

TEST_F(AutoPlayerTest, GoesToWhereTheRulesPutABallThatWasOut) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.feet = {{2.5, 0.5}, 0.5};
  world.ball = {4, 1};
  run(1);
  // A kick over the end line, which a defender touched last: a corner kick. Nobody sees it.
  world.ball = {4.7, 1.5};
  run(1);
  world.is_ball_visible = false;
  world.ball = {4.5, 3};
  for (int i = 0; i < 200; ++i) {
    world.match->ball_out = {1 + i * ToyWorld::kPeriod, true};
    world.step();
  }
  // Towards the corner, not to where it was seen.
  EXPECT_LT((world.feet.position - Vector2d(4.5, 3)).norm(), 1.3);
}

TEST_F(AutoPlayerTest, KeepsAwayFromTheOthersFreeKickUntilTheBallIsFree) {
  world.match->phase = MatchPhase::kPlaying;
  world.match->kicks_off = true;
  world.feet = {{0.8, 2.6}, 0.5};
  world.ball = {1, 3};
  for (int i = 0; i < 400; ++i) {
    world.match->ball_out = {2 + i * ToyWorld::kPeriod, false};
    world.step();
  }
  EXPECT_GT((world.feet.position - world.ball).norm(), 0.75);
  EXPECT_THAT(world.actions, IsEmpty());
  world.match->ball_out.reset();
  run(20);
  EXPECT_FALSE(world.actions.empty());
}

TEST_F(AutoPlayerTest, WithoutAMatchItStands) {
  world.match.reset();
  run(3);
  EXPECT_EQ(world.core.state().reason.code, "match-not-played");
  EXPECT_LT((world.feet.position - Vector2d(-2, 1)).norm(), 0.01);
}

}  // namespace
}  // namespace nao::play
