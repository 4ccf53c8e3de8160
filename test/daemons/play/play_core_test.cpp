#include "daemons/play/play_core.h"

#include <gmock/gmock.h>

#include "daemons/play/ball_memory.h"
#include "test/daemons/play/toy_world.h"

namespace nao::play {
namespace {

using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::SizeIs;

std::string last_reason(const ToyWorld& world) {
  return world.results.empty() ? "" : world.results.back().reason.code;
}

ResultStatus last_status(const ToyWorld& world) {
  return world.results.back().status;
}

TEST(Score, PutsTheBallIntoTheGoalFromAnywhereInTheOwnHalf) {
  for (const double x : {-4.0, -2.0, -0.3}) {
    for (const double y : {-2.5, 0.0, 2.5}) {
      for (const double heading : {0.0, 1.5, 3.1}) {
        ToyWorld world;
        world.ball = {x, y};
        world.feet = {{x * 0.5 - 1.6, -0.6 * y}, heading};
        world.command(Behavior::kScore);
        const double start = world.time;
        while (world.ball.x() < 4.5 && world.time - start < 100) world.step();
        EXPECT_LT(world.time - start, 90) << x << ' ' << y << ' ' << heading;
        // It says so when it is near enough to see it.
        world.run(30);
        EXPECT_EQ(last_status(world), ResultStatus::kDone)
            << x << ' ' << y << ' ' << heading << ": " << last_reason(world);
        EXPECT_GT(world.ball.x(), 4.5);
        EXPECT_LT(std::abs(world.ball.y()), 0.75);
        // The robot must never run over the ball.
        EXPECT_GT(world.least_distance, 0.14);
      }
    }
  }
}

TEST(Score, WalksAroundABallThatLiesBetweenItAndTheOwnGoal) {
  ToyWorld world;
  world.ball = {-1, 0};
  world.feet = {{0, 0}, M_PI};
  world.command(Behavior::kScore);
  world.run(120);
  EXPECT_EQ(last_status(world), ResultStatus::kDone);
  EXPECT_GT(world.ball.x(), 4.5);
}

TEST(Score, TellsItsPhases) {
  ToyWorld world;
  world.command(Behavior::kScore);
  world.run(60);
  EXPECT_THAT(world.phases, Contains(PlayPhase::kApproach));
  EXPECT_THAT(world.phases, Contains(PlayPhase::kAlign));
  EXPECT_THAT(world.phases, Contains(PlayPhase::kKick));
  EXPECT_EQ(world.phases.back(), PlayPhase::kDone);
}

TEST(Score, LooksWithTheLowerCameraWhenTheBallIsNear) {
  ToyWorld world;
  world.ball = {2.5, 0};
  world.command(Behavior::kScore);
  world.run(60);
  ASSERT_THAT(world.cameras, SizeIs(testing::Ge(2u)));
  EXPECT_EQ(world.cameras.front(), "top");
  EXPECT_THAT(world.cameras, Contains("bottom"));
}

TEST(Score, FindsABallBehindIt) {
  ToyWorld world;
  world.feet = {{0, 0}, 0};
  world.ball = {-1.5, 0.2};
  world.command(Behavior::kScore);
  world.run(120);
  EXPECT_EQ(last_status(world), ResultStatus::kDone);
  EXPECT_EQ(world.phases.front(), PlayPhase::kSearch);
}

/** Heading of the kick of a robot that starts with the ball in front of its left foot, but turned
 * away from the goal's middle by 0.14 rad. */
double heading_of_first_kick(const Eigen::Vector2d& ball) {
  ToyWorld world;
  world.ball = ball;
  world.feet.heading = 0.14;
  world.feet.position = ball - world.feet.rotate({0.18, 0.05});
  world.command(Behavior::kScore);
  for (int i = 0; i < 600 && world.actions.empty(); ++i) world.step();
  EXPECT_FALSE(world.actions.empty());
  return world.feet.heading;
}

TEST(Score, AimsOnlyRoughlyWhereAKickDoesNotReachTheGoal) {
  EXPECT_LT(heading_of_first_kick({0.5, 0}), 0.1);
  EXPECT_NEAR(heading_of_first_kick({-3.5, 0}), 0.14, 0.02);
}

TEST(Score, JudgesFromNearWhetherTheBallIsOut) {
  ToyWorld world;
  world.ball = {0, 3.5};
  world.feet = {{-3.5, 3}, 0};
  world.command(Behavior::kScore);
  world.run(4);
  EXPECT_TRUE(world.core.is_active());
  world.run(20);
  EXPECT_EQ(last_status(world), ResultStatus::kFailed);
  EXPECT_EQ(world.results.back().reason.code, "ball-out");
  EXPECT_LT((world.ball - world.feet.position).norm(), 2.1);
}

Ball ball_at(double x, double time) {
  Ball ball;
  ball.position = {x, 0};
  ball.seen_time = time;
  return ball;
}

TEST(BallMemory, ConfirmsABallThatIsSeenThreeTimesAboutOnePlace) {
  const PlayParameters parameters = PlayParameters::load("");
  BallMemory memory(parameters.ball_memory);
  memory.take(ball_at(2, 10), {});
  // The same sighting in the next step.
  memory.take(ball_at(2, 10), {});
  memory.take(ball_at(2.2, 10.1), {});
  EXPECT_FALSE(memory.is_confirmed());
  EXPECT_TRUE(memory.is_candidate(10.2));
  EXPECT_FALSE(memory.is_candidate(12));
  memory.take(ball_at(1.9, 10.2), {});
  EXPECT_TRUE(memory.is_confirmed());
  memory.take(ball_at(4, 10.3), {});
  EXPECT_FALSE(memory.is_confirmed());
  memory.take(std::nullopt, {});
  EXPECT_FALSE(memory.is_candidate(10.3));
}

TEST(Score, FollowsAKickedBallThatRollsOutOfSight) {
  ToyWorld world;
  world.sight = 2.5;
  world.ball = {-3, 0.5};
  world.feet = {{-4, 0}, 0};
  world.command(Behavior::kScore);
  EXPECT_LT(world.run(120), 90);
  EXPECT_EQ(last_status(world), ResultStatus::kDone);
}

TEST(Score, GivesUpABallThatIsNowhere) {
  ToyWorld world;
  world.is_ball_visible = false;
  world.command(Behavior::kScore);
  world.run(300);
  EXPECT_EQ(last_status(world), ResultStatus::kFailed);
  EXPECT_EQ(last_reason(world), "ball-not-found");
}

TEST(Kick, KicksOnceAndIsDone) {
  ToyWorld world;
  world.command(Behavior::kKick);
  world.run(60);
  EXPECT_EQ(last_status(world), ResultStatus::kDone);
  EXPECT_THAT(world.actions, SizeIs(1));
  EXPECT_GT(world.ball.x(), 1.5);
}

TEST(Kick, UsesTheFootOnWhoseSideTheBallLies) {
  for (const double y : {-0.4, 0.4}) {
    ToyWorld world;
    world.ball = {1, y};
    world.command(Behavior::kKick);
    world.run(60);
    EXPECT_THAT(world.actions, ElementsAre(y > 0 ? "kick-left" : "kick-right"));
  }
}

TEST(GoToBall, StopsBeforeIt) {
  ToyWorld world;
  world.ball = {1.5, 1};
  world.command(Behavior::kGoToBall);
  world.run(60);
  EXPECT_EQ(last_status(world), ResultStatus::kDone);
  EXPECT_NEAR((world.ball - world.feet.position).norm(), 0.27, 0.08);
  EXPECT_THAT(world.actions, SizeIs(0));
}

TEST(KeepGoal, StandsBetweenBallAndGoal) {
  ToyWorld world;
  world.feet = {{-3, 0.5}, 0};
  world.ball = {-2.5, -1};
  world.command(Behavior::kKeepGoal);
  world.run(30);
  const Eigen::Vector2d goal(-4.5, 0);
  const Eigen::Vector2d way = (world.ball - goal).normalized();
  const Eigen::Vector2d place = world.feet.position - goal;
  EXPECT_NEAR(place.dot(way), 0.5, 0.12);
  EXPECT_LT(std::abs(place.x() * way.y() - place.y() * way.x()), 0.2);
  EXPECT_EQ(world.walk.vx, 0);
}

TEST(KeepGoal, BlocksAShotAtItAndDivesForOneBesideIt) {
  for (const auto& [aim, action] :
       {std::pair{0.0, "block"}, {0.6, "dive-left"}, {-0.6, "dive-right"}}) {
    ToyWorld world;
    world.feet = {{-4, 0}, 0};
    world.ball = {-2.5, 0};
    world.command(Behavior::kKeepGoal);
    for (int i = 0; i < 60; ++i) world.step();
    world.ball_velocity = 1.6 * (Eigen::Vector2d(-4.5, aim) - world.ball).normalized();
    for (int i = 0; i < 35; ++i) world.step();
    EXPECT_THAT(world.actions, ElementsAre(action)) << aim;
  }
}

TEST(KeepGoal, LeavesABallAloneThatMissesTheGoal) {
  ToyWorld world;
  world.feet = {{-4, 0}, 0};
  world.ball = {-2.5, 0};
  world.command(Behavior::kKeepGoal);
  for (int i = 0; i < 60; ++i) world.step();
  world.ball_velocity = 1.6 * (Eigen::Vector2d(-4.5, 1.4) - world.ball).normalized();
  for (int i = 0; i < 60; ++i) world.step();
  EXPECT_THAT(world.actions, SizeIs(0));
}

class PlayLease : public testing::Test {
 protected:
  void begin() {
    world_.ball = {3, 0};
    world_.command(Behavior::kScore);
    for (int i = 0; i < 40; ++i) world_.step();
    ASSERT_TRUE(world_.core.is_active());
    ASSERT_GT(world_.walk.vx, 0.05);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) world_.step();
  }
  ToyWorld world_;
};

TEST_F(PlayLease, StopsWhenNobodyRepeatsTheCommand) {
  begin();
  world_.stop_commanding();
  steps(30);
  EXPECT_TRUE(world_.core.is_active());
  steps(30);
  EXPECT_FALSE(world_.core.is_active());
  EXPECT_EQ(last_reason(world_), "play-command-timeout");
  EXPECT_EQ(world_.walk.vx, 0);
}

TEST_F(PlayLease, EndsWithAnotherSendersCommandWithoutAStopOfItsOwn) {
  begin();
  world_.commands.clear();
  world_.other_command = CommandKind::kWalk;
  world_.stop_commanding();
  steps(20);
  EXPECT_FALSE(world_.core.is_active());
  EXPECT_EQ(last_status(world_), ResultStatus::kInterrupted);
  EXPECT_EQ(last_reason(world_), "replaced");
  EXPECT_THAT(world_.commands, SizeIs(0));
}

TEST_F(PlayLease, IsNotBegunAgainByARepetition) {
  begin();
  world_.other_command = CommandKind::kStop;
  steps(40);
  EXPECT_FALSE(world_.core.is_active());
}

TEST_F(PlayLease, EndsAtOnceByTheBehaviorNone) {
  begin();
  world_.command(Behavior::kNone);
  PlayInput input;
  input.now = input.time = world_.time;
  input.mode = Mode::kWalking;
  input.robot = RobotView{};
  input.requests = {{"test", 99, {Behavior::kNone}}};
  const PlayOutput output = world_.core.step(input);
  EXPECT_FALSE(world_.core.is_active());
  ASSERT_THAT(output.commands, SizeIs(1));
  const auto& walk = std::get<WalkCommand>(output.commands[0].request);
  EXPECT_EQ(walk.vx, 0);
  EXPECT_EQ(walk.wz, 0);
}

TEST_F(PlayLease, StandsWithoutImagesAndGoesOnWithThem) {
  begin();
  world_.has_images = false;
  steps(60);
  EXPECT_EQ(world_.walk.vx, 0);
  EXPECT_EQ(world_.core.state().reason.code, "vision-unavailable");
  world_.has_images = true;
  steps(20);
  EXPECT_GT(world_.walk.vx, 0);
  EXPECT_TRUE(world_.core.state().reason.empty());
}

TEST_F(PlayLease, FailsWithoutImagesInTheEnd) {
  begin();
  world_.has_images = false;
  steps(400);
  EXPECT_FALSE(world_.core.is_active());
  EXPECT_EQ(last_reason(world_), "vision-unavailable");
}

TEST_F(PlayLease, StandsWhileTheCameraIsCovered) {
  begin();
  world_.image_status = 1;
  steps(20);
  EXPECT_EQ(world_.walk.vx, 0);
  EXPECT_EQ(world_.core.state().reason.code, "image-unusable");
}

TEST_F(PlayLease, WaitsUntilAFallenRobotStands) {
  begin();
  world_.mode = Mode::kFallen;
  world_.commands.clear();
  steps(30);
  EXPECT_EQ(world_.core.state().phase, PlayPhase::kRecover);
  EXPECT_EQ(world_.core.state().reason.code, "robot-fallen");
  EXPECT_THAT(world_.commands, SizeIs(0));
  world_.mode = Mode::kHolding;
  steps(20);
  EXPECT_EQ(world_.core.state().phase, PlayPhase::kApproach);
}

TEST_F(PlayLease, CommandsNothingWhileTheRobotGetsUp) {
  begin();
  world_.mode = Mode::kGettingUp;
  world_.commands.clear();
  steps(30);
  EXPECT_EQ(world_.core.state().phase, PlayPhase::kRecover);
  EXPECT_EQ(world_.core.state().reason.code, "robot-getting-up");
  EXPECT_THAT(world_.commands, SizeIs(0));
  // Once on its feet, it continues while nao-motion still straightens the legs.
  world_.mode = Mode::kMoving;
  steps(20);
  EXPECT_EQ(world_.core.state().phase, PlayPhase::kApproach);
}

TEST_F(PlayLease, FailsWhenTheRobotNeedsHelpOrIsGone) {
  begin();
  world_.mode = Mode::kFallen;
  world_.needs_help = true;
  steps(2);
  EXPECT_EQ(last_reason(world_), "robot-fallen");
  world_.needs_help = false;
  world_.mode = Mode::kHolding;
  begin();
  world_.has_robot = false;
  steps(2);
  EXPECT_EQ(last_reason(world_), "no-robot");
}

TEST(PlayCore, RefusesWhatItCannotDo) {
  ToyWorld world;
  world.command(static_cast<Behavior>(77));
  world.step();
  EXPECT_EQ(last_status(world), ResultStatus::kRefused);
  EXPECT_EQ(last_reason(world), "behavior-unknown");
  world.has_robot = false;
  world.command(Behavior::kScore);
  world.step();
  EXPECT_EQ(last_reason(world), "no-robot");
  EXPECT_FALSE(world.core.is_active());
}

TEST(PlayCore, SendsNothingBeforeTheFirstCommand) {
  ToyWorld world;
  for (int i = 0; i < 20; ++i) world.step();
  EXPECT_THAT(world.commands, SizeIs(0));
  EXPECT_THAT(world.cameras, SizeIs(0));
  EXPECT_EQ(world.core.state().behavior, Behavior::kNone);
}

}  // namespace
}  // namespace nao::play
