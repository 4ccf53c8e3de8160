#include "daemons/referee/referee_core.h"

#include <gmock/gmock.h>

#include "common/error.h"
#include "kinematics/formation.h"

namespace nao::referee {
namespace {

using testing::ElementsAre;

/** A world of four robots that do what the test says. */
struct RefereeCoreTest : testing::Test {
  RefereeCoreTest() {
    input.time = 100;
    for (const MatchPlayer& player : core.state().players) {
      RobotSighting robot;
      robot.name = player.robot;
      robot.is_autonomous = true;
      robot.position = place(player);
      input.robots.push_back(robot);
    }
  }

  static std::vector<MatchPlayer> players() {
    return {{"A1", 0, 1}, {"A2", 0, 2}, {"B1", 1, 1}, {"B2", 1, 2}};
  }

  Eigen::Vector2d place(const MatchPlayer& player) const {
    return team_in_field(player.team) *
           kick_off_place(player.number, 2, player.team == core.state().kickoff_team, {4.5, 3})
               .position;
  }

  void run(double duration) {
    for (const double end = input.time + duration; input.time < end - 1e-9;) {
      input.time += 0.05;
      const RefereeOutput output = core.step(input);
      for (const MatchEvent& event : output.events) events.push_back(event);
      for (const Placement& placement : output.placements) {
        placements.push_back(placement);
        if (placement.robot.empty()) {
          input.ball.head<2>() = placement.pose.position;
        } else {
          find(placement.robot).position = placement.pose.position;
          find(placement.robot).is_upright = true;
        }
      }
    }
  }

  void start() {
    run(0.1);
    ASSERT_FALSE(core.overrule({MatchOperation::kStart}));
    run(14);
    ASSERT_EQ(core.state().phase, MatchPhase::kPlaying);
    events.clear();
    placements.clear();
  }

  void walk_to_places() {
    for (const MatchPlayer& player : core.state().players)
      find(player.robot).position = place(player);
  }

  RobotSighting& find(const std::string& name) {
    for (RobotSighting& robot : input.robots) {
      if (robot.name == name) return robot;
    }
    throw Error("no robot " + name);
  }

  std::vector<MatchEventKind> kinds() const {
    std::vector<MatchEventKind> result;
    for (const MatchEvent& event : events) result.push_back(event.kind);
    return result;
  }

  RefereeCore core{players(), SceneFile::find("soccer"), {}, 7};
  RefereeInput input;
  std::vector<MatchEvent> events;
  std::vector<Placement> placements;
};

TEST_F(RefereeCoreTest, WaitsForTheOperatorThenReadySetAndWhistle) {
  run(60);
  EXPECT_EQ(core.state().phase, MatchPhase::kInitial);
  ASSERT_FALSE(core.overrule({MatchOperation::kStart}));
  run(9.9);
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
  run(0.3);
  EXPECT_EQ(core.state().phase, MatchPhase::kSet);
  ASSERT_EQ(placements.size(), 1u);
  EXPECT_EQ(placements[0].robot, "");
  run(3.1);
  EXPECT_EQ(core.state().phase, MatchPhase::kPlaying);
  EXPECT_THAT(kinds(), ElementsAre(MatchEventKind::kKickOff));
  const double time_left = core.state().time_left;
  EXPECT_NEAR(time_left, 300, 0.5);
  run(10);
  EXPECT_NEAR(time_left - core.state().time_left, 10, 1e-6);
}

TEST_F(RefereeCoreTest, PutsRobotsToTheirPlacesThatAreNotThereInTime) {
  run(0.1);
  find("A2").position = {1, 1};
  find("B1").is_upright = false;
  ASSERT_FALSE(core.overrule({MatchOperation::kStart}));
  run(44);
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
  run(1.2);
  EXPECT_EQ(core.state().phase, MatchPhase::kSet);
  // One robot has not got up and was penalised before; the other one was put at its place.
  ASSERT_EQ(placements.size(), 3u);
  EXPECT_EQ(placements[0].robot, "B1");
  EXPECT_EQ(placements[1].robot, "A2");
  EXPECT_NEAR(placements[1].pose.position.x(), -0.92 * 4.5, 1e-9);
}

TEST_F(RefereeCoreTest, CountsAGoalOnceAndLetsTheOthersKickOff) {
  start();
  input.ball = {4.7, 0.2, 0.05};
  run(0.3);
  EXPECT_THAT(core.state().score, ElementsAre(1, 0));
  EXPECT_THAT(kinds(), ElementsAre(MatchEventKind::kGoal));
  EXPECT_EQ(events[0].team, 0);
  EXPECT_EQ(core.state().kickoff_team, 1);
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
  const double time_left = core.state().time_left;
  walk_to_places();
  run(14);
  EXPECT_EQ(core.state().phase, MatchPhase::kPlaying);
  EXPECT_THAT(core.state().score, ElementsAre(1, 0));
  EXPECT_TRUE(input.ball.head<2>().isZero());
  // The clock of a half that has begun runs during a kick-off, too.
  EXPECT_NEAR(core.state().time_left, time_left - 14, 1e-6);
}

TEST_F(RefereeCoreTest, EndsTheHalfDuringAKickOffToo) {
  start();
  find("A1").touches_ball = true;
  run(290);
  ASSERT_FALSE(core.overrule({MatchOperation::kGoal, 0}));
  run(12);
  EXPECT_EQ(core.state().half, 2);
  EXPECT_EQ(core.state().time_left, 300) << "the second half begins with its whistle";
}

TEST_F(RefereeCoreTest, EndsTheMatchWhenATeamIsTenGoalsAhead) {
  start();
  for (int goal = 0; goal < 9; ++goal) ASSERT_FALSE(core.overrule({MatchOperation::kGoal, 1}));
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
  ASSERT_FALSE(core.overrule({MatchOperation::kGoal, 1}));
  EXPECT_EQ(core.state().phase, MatchPhase::kFinished);
  EXPECT_EQ(core.state().event.kind, MatchEventKind::kMatchEnd);
}

TEST_F(RefereeCoreTest, PenalisesATeamLongerEachTimeButNotForGettingUp) {
  start();
  const auto penalize = [&](const std::string& robot) {
    EXPECT_FALSE(core.overrule({MatchOperation::kPenalize, 0, robot}));
    return find_player(core.state(), robot)->penalty_left;
  };
  find("A2").is_upright = false;
  run(20.2);
  ASSERT_EQ(find_player(core.state(), "A2")->penalty, Penalty::kNotGettingUp);
  EXPECT_EQ(penalize("A1"), 30);
  EXPECT_EQ(penalize("A1"), 45);
  EXPECT_EQ(penalize("B1"), 30) << "the other team";
  EXPECT_EQ(penalize("A2"), 60);
}

TEST_F(RefereeCoreTest, CountsNoPenaltyDownInSetAndNoneOverTheHalf) {
  run(0.1);
  ASSERT_FALSE(core.overrule({MatchOperation::kStart}));
  run(10.1);
  ASSERT_EQ(core.state().phase, MatchPhase::kSet);
  ASSERT_FALSE(core.overrule({MatchOperation::kPenalize, 0, "A1"}));
  run(2);
  ASSERT_EQ(core.state().phase, MatchPhase::kSet);
  EXPECT_EQ(find_player(core.state(), "A1")->penalty_left, 30);
  ASSERT_FALSE(core.overrule({MatchOperation::kEndHalf}));
  EXPECT_EQ(find_player(core.state(), "A1")->penalty, Penalty::kNone);
}

TEST_F(RefereeCoreTest, PutsABallBackThatLeftTheField) {
  start();
  find("A1").touches_ball = true;
  run(0.1);
  find("A1").touches_ball = false;
  input.ball = {2, -3.3, 0.05};
  run(0.2);
  EXPECT_THAT(kinds(), ElementsAre(MatchEventKind::kBallOut));
  EXPECT_EQ(events[0].team, 1);
  run(1.2);
  EXPECT_THAT(kinds(), ElementsAre(MatchEventKind::kBallOut));
  EXPECT_TRUE(input.ball.head<2>().isApprox(Eigen::Vector2d(2, -3)));
  EXPECT_EQ(core.state().phase, MatchPhase::kPlaying);
}

TEST_F(RefereeCoreTest, KeepsTheOthersAwayFromAKickInUntilTheBallIsFree) {
  start();
  find("A1").touches_ball = true;
  run(0.1);
  find("A1").touches_ball = false;
  input.ball = {2, -3.3, 0.05};
  run(1.5);
  find("A2").position = {2, -2.6};
  run(5.2);
  EXPECT_THAT(kinds(), ElementsAre(MatchEventKind::kBallOut, MatchEventKind::kPenalty));
  EXPECT_EQ(events.back().robot, "A2");
  // Team 0 moves the ball: it is put back.
  find("A1").touches_ball = true;
  input.ball = {2.5, -2.8, 0.05};
  run(0.1);
  find("A1").touches_ball = false;
  EXPECT_TRUE(input.ball.head<2>().isApprox(Eigen::Vector2d(2, -3)));
  EXPECT_EQ(find_player(core.state(), "A1")->penalty, Penalty::kOperator);
  find("B1").touches_ball = true;
  input.ball = {1.8, -2.9, 0.05};
  run(0.1);
  EXPECT_EQ(events.back().kind, MatchEventKind::kBallFree);
}

TEST_F(RefereeCoreTest, PenalisesRobotsThatLeaveOrDoNotGetUp) {
  start();
  find("A1").position = {0, 4};
  find("B2").is_upright = false;
  run(4.9);
  EXPECT_TRUE(events.empty());
  run(0.3);
  EXPECT_THAT(kinds(), ElementsAre(MatchEventKind::kPenalty));
  EXPECT_EQ(find_player(core.state(), "A1")->penalty, Penalty::kLeftField);
  EXPECT_NEAR(find("A1").position.y(), 3.35, 1e-9);
  run(15);
  EXPECT_EQ(find_player(core.state(), "B2")->penalty, Penalty::kNotGettingUp);
  EXPECT_TRUE(find("B2").is_upright);
  run(15);
  EXPECT_EQ(find_player(core.state(), "A1")->penalty, Penalty::kNone);
  EXPECT_EQ(events.back().kind, MatchEventKind::kPenaltyEnd);
  EXPECT_EQ(events.back().robot, "A1");
}

TEST_F(RefereeCoreTest, PlaysTwoHalvesAndEnds) {
  start();
  find("A1").touches_ball = true;
  run(301);
  EXPECT_EQ(core.state().half, 2);
  EXPECT_EQ(core.state().kickoff_team, 1);
  walk_to_places();
  run(14 + 301);
  EXPECT_EQ(core.state().phase, MatchPhase::kFinished);
  EXPECT_EQ(events.back().kind, MatchEventKind::kMatchEnd);
  const int64_t last = core.state().event.id;
  input.ball = {4.7, 0, 0.05};
  run(10);
  EXPECT_EQ(core.state().event.id, last);
}

TEST_F(RefereeCoreTest, NumbersEventsWithoutGaps) {
  start();
  const int64_t first = core.state().event.id;
  for (int goal = 0; goal < 3; ++goal) ASSERT_FALSE(core.overrule({MatchOperation::kGoal, 1}));
  run(0.1);
  ASSERT_EQ(events.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(events[static_cast<size_t>(i)].id, first + 1 + i);
  EXPECT_THAT(core.state().score, ElementsAre(0, 3));
}

TEST_F(RefereeCoreTest, KicksOffAnewWhenNobodyFindsTheBall) {
  start();
  run(59);
  EXPECT_EQ(core.state().phase, MatchPhase::kPlaying);
  run(2);
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
  EXPECT_EQ(core.state().kickoff_team, 1);
}

TEST_F(RefereeCoreTest, TheOperatorOverrules) {
  start();
  EXPECT_FALSE(core.overrule({MatchOperation::kGoal, 0}));
  EXPECT_FALSE(core.overrule({MatchOperation::kTakeBackGoal, 0}));
  EXPECT_FALSE(core.overrule({MatchOperation::kTakeBackGoal, 0}));
  EXPECT_THAT(core.state().score, ElementsAre(0, 0));
  EXPECT_FALSE(core.overrule({MatchOperation::kPenalize, 0, "B1"}));
  EXPECT_EQ(find_player(core.state(), "B1")->penalty, Penalty::kOperator);
  EXPECT_FALSE(core.overrule({MatchOperation::kRelease, 0, "B1"}));
  EXPECT_EQ(find_player(core.state(), "B1")->penalty, Penalty::kNone);
  EXPECT_FALSE(core.overrule({MatchOperation::kEndHalf}));
  EXPECT_EQ(core.state().half, 2);
  EXPECT_FALSE(core.overrule({MatchOperation::kFinish}));
  EXPECT_EQ(core.state().phase, MatchPhase::kFinished);
  EXPECT_EQ(core.overrule({MatchOperation::kGoal, 0})->code, "match-operation-too-late");
  EXPECT_FALSE(core.overrule({MatchOperation::kNewMatch}));
  EXPECT_EQ(core.state().id, 8);
  EXPECT_EQ(core.state().phase, MatchPhase::kInitial);
}

TEST_F(RefereeCoreTest, RefusesWhatMakesNoSense) {
  EXPECT_EQ(core.overrule({static_cast<MatchOperation>(9)})->code, "match-operation-unknown");
  EXPECT_EQ(core.overrule({MatchOperation::kGoal, 2})->code, "match-team-unknown");
  EXPECT_EQ(core.overrule({MatchOperation::kPenalize, 0, "C3"})->code, "match-robot-unknown");
  EXPECT_EQ(core.overrule({MatchOperation::kGoal, 0})->code, "match-operation-too-late");
}

TEST_F(RefereeCoreTest, AnotherRefereeGoesOnWithScoreAndClock) {
  start();
  ASSERT_FALSE(core.overrule({MatchOperation::kGoal, 0}));
  walk_to_places();
  run(30);
  RefereeCore other(players(), SceneFile::find("soccer"), {}, 8);
  other.restore(core.state());
  EXPECT_EQ(other.state().id, 7);
  EXPECT_THAT(other.state().score, ElementsAre(1, 0));
  EXPECT_EQ(other.state().phase, MatchPhase::kPlaying);
  const double time_left = other.state().time_left;
  other.step(input);
  input.time += 0.05;
  other.step(input);
  EXPECT_NEAR(other.state().time_left, time_left - 0.05, 1e-9);
}

TEST_F(RefereeCoreTest, ANewSimulatorGoesOnWithAKickOff) {
  start();
  run(20);
  const double time_left = core.state().time_left;
  input.time = 0;
  core.step(input);
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
  EXPECT_EQ(core.state().time_left, time_left);
  // A gap in time does not count as played.
  input.time = 30;
  core.step(input);
  EXPECT_EQ(core.state().phase, MatchPhase::kReady);
}

TEST_F(RefereeCoreTest, ARobotOnTheMarkIsPutBackBeforeTheBallIs) {
  run(0.1);
  ASSERT_FALSE(core.overrule({MatchOperation::kStart}));
  find("A1").position = {-0.1, 0};
  run(50);
  ASSERT_FALSE(placements.empty());
  EXPECT_EQ(placements[0].robot, "A1");
  EXPECT_LT(placements[0].pose.position.x(), -0.3);
}

TEST(RefereeCore, NeedsTwoTeamsAndAField) {
  const SceneFile soccer = SceneFile::find("soccer");
  EXPECT_THROW(RefereeCore({{"A1", 0, 1}}, soccer, {}, 1), ConfigError);
  EXPECT_THROW(RefereeCore(RefereeCoreTest::players(), SceneFile::find("empty"), {}, 1),
               ConfigError);
}

}  // namespace
}  // namespace nao::referee
