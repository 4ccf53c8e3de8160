// Messages of the GameController, and the referee that follows it.
#include <gmock/gmock.h>

#include <cstring>

#include "common/error.h"
#include "daemons/referee/game_controller_referee.h"
#include "test/daemons/referee/game_controller_packet.h"

namespace nao::referee {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Property;
using testing::Throws;

TEST(GameControllerMessage, IsRead) {
  GameControllerPacket packet;
  packet.state = 3;
  packet.set_play = 4;
  packet.first_half = 0;
  packet.kicking_team = 12;
  packet.seconds = -7;
  packet.scores = {2, 9};
  packet.penalties[1][1] = {6, 44};
  const GameControllerData data = decode_game_controller(packet.bytes());
  EXPECT_EQ(data.version, 18);
  EXPECT_EQ(data.state, GameControllerData::State::kPlaying);
  EXPECT_EQ(data.set_play, GameControllerData::SetPlay::kKickIn);
  EXPECT_FALSE(data.is_first_half);
  EXPECT_EQ(data.kicking_team, 12);
  EXPECT_EQ(data.time_left, -7);
  EXPECT_EQ(data.teams[0].number, 5);
  EXPECT_EQ(data.teams[0].score, 2);
  EXPECT_EQ(data.teams[1].score, 9);
  EXPECT_EQ(data.teams[1].players[1].kind, Penalty::kLeftField);
  EXPECT_EQ(data.teams[1].players[1].time_left, 44);
}

TEST(GameControllerMessage, OfTheMergedLeagueIsRead) {
  using SetPlay = GameControllerData::SetPlay;
  struct Version {
    uint8_t number;
    size_t size;
    uint8_t pushing, incapable, leaving, last;
  };
  for (const auto& [number, size, pushing, incapable, leaving, last] :
       {Version{19, 198, 9, 4, 7, 11}, Version{20, 158, 10, 5, 8, 13}}) {
    SCOPED_TRACE(int{number});
    GameControllerPacket packet;
    packet.version = number;
    packet.state = 3;
    packet.stopped = 1;
    packet.scores = {1, 3};
    packet.penalties = {{{{{pushing, 45}, {incapable, 0}}}, {{{leaving, 9}, {last, 0}}}}};
    ASSERT_EQ(packet.bytes().size(), size);
    const GameControllerData data = decode_game_controller(packet.bytes());
    EXPECT_EQ(data.version, number);
    EXPECT_TRUE(data.is_stopped);
    EXPECT_EQ(data.teams[1].number, 12);
    EXPECT_EQ(data.teams[1].score, 3);
    EXPECT_EQ(data.teams[0].players[0].kind, Penalty::kPushing);
    EXPECT_EQ(data.teams[0].players[0].time_left, 45);
    EXPECT_EQ(data.teams[0].players[1].kind, Penalty::kNotGettingUp);
    EXPECT_EQ(data.teams[1].players[0].kind, Penalty::kLeftField);
    EXPECT_EQ(data.teams[1].players[1].kind, Penalty::kOperator);
    EXPECT_EQ(data.teams[1].players[2].kind, Penalty::kNone);
    // In the order of their codes: none, direct and indirect free kick, penalty kick, throw-in,
    // goal kick, corner kick.
    std::vector<SetPlay> set_plays;
    for (packet.set_play = 0; packet.set_play < 7; ++packet.set_play) {
      set_plays.push_back(decode_game_controller(packet.bytes()).set_play);
    }
    EXPECT_THAT(set_plays, ElementsAre(SetPlay::kNone, SetPlay::kFreeKick, SetPlay::kFreeKick,
                                       SetPlay::kPenaltyKick, SetPlay::kKickIn, SetPlay::kGoalKick,
                                       SetPlay::kCornerKick));
  }
}

TEST(GameControllerMessage, OfEveryVersionIsRead) {
  for (uint8_t version = 15; version <= 20; ++version) {
    GameControllerPacket packet;
    packet.version = version;
    EXPECT_EQ(decode_game_controller(packet.bytes()).version, version);
  }
}

TEST(GameControllerMessage, OfWrongSizeHeaderVersionOrValueIsRefused) {
  const auto expect_refused = [](const std::vector<uint8_t>& bytes, const char* words) {
    EXPECT_THAT([&] { (void)decode_game_controller(bytes); },
                Throws<Error>(Property(&Error::what, HasSubstr(words))));
  };
  const std::vector<uint8_t> good = GameControllerPacket().bytes();
  expect_refused({}, "not a GameController message");
  expect_refused({'R', 'G', 'r', 't', 18}, "not a GameController message");
  expect_refused({good.begin(), good.end() - 1}, "117 bytes instead of 118");
  GameControllerPacket packet;
  packet.version = 21;
  expect_refused(packet.bytes(), "version 21; known are 15 to 20");
  packet.version = 20;
  std::vector<uint8_t> cut = packet.bytes();
  cut.resize(118);
  expect_refused(cut, "118 bytes instead of 158");
  packet.state = 5;
  expect_refused(packet.bytes(), "unknown state 5");
  packet.state = 0;
  packet.set_play = 7;
  expect_refused(packet.bytes(), "unknown set play 7");
  packet = {};
  packet.state = 6;
  expect_refused(packet.bytes(), "unknown state 6");
  packet = {};
  packet.set_play = 6;
  expect_refused(packet.bytes(), "unknown set play 6");
}

TEST(GameControllerMessage, OfARobotHasTheBytesOfTheHeaderFile) {
  GameControllerReturn data;
  data.player_number = 3;
  data.team_number = 12;
  data.is_fallen = true;
  data.pose = {1.5, -2, 0.25};
  data.ball_age = 0.5;
  data.ball = {0.1, -0.2};
  const auto bytes = encode(data);
  EXPECT_EQ(std::memcmp(bytes.data(), "RGrt", 4), 0);
  EXPECT_THAT((std::array<uint8_t, 4>{bytes[4], bytes[5], bytes[6], bytes[7]}),
              ElementsAre(4, 3, 12, 1));
  float values[6];
  std::memcpy(values, &bytes[8], sizeof values);
  EXPECT_THAT(values, ElementsAre(1500, -2000, 0.25F, 0.5F, 100, -200));
  data.ball_age.reset();
  std::memcpy(values, &encode(data)[8], sizeof values);
  EXPECT_EQ(values[3], -1);
}

class GameControllerRefereeTest : public testing::Test {
 protected:
  GameControllerRefereeTest() {
    for (const MatchPlayer& player : players()) {
      RobotSighting robot;
      robot.name = player.robot;
      // In its own half, outside the circle.
      robot.position = {player.team == 0 ? -2 : 2, player.number};
      input_.robots.push_back(robot);
    }
  }

  static std::vector<MatchPlayer> players() {
    return {{"A1", 0, 1}, {"A2", 0, 2}, {"B1", 1, 1}, {"B2", 1, 2}};
  }

  /** The GameController says this, and the referee follows. */
  RefereeOutput say(const GameControllerPacket& packet) {
    referee_.receive(decode_game_controller(packet.bytes()));
    input_.time += 0.05;
    return referee_.step(input_);
  }
  static std::vector<MatchEventKind> kinds(const RefereeOutput& output) {
    std::vector<MatchEventKind> kinds;
    for (const MatchEvent& event : output.events) kinds.push_back(event.kind);
    return kinds;
  }

  GameControllerReferee referee_{players(), SceneFile::find("soccer"), std::nullopt, 1};
  GameControllerPacket packet_;
  RefereeInput input_;
};

TEST_F(GameControllerRefereeTest, FollowsPhasesHalvesAndClock) {
  EXPECT_EQ(referee_.step(input_).events.size(), 0u);
  const std::pair<int, MatchPhase> phases[] = {
      {0, MatchPhase::kInitial}, {5, MatchPhase::kInitial}, {1, MatchPhase::kReady},
      {2, MatchPhase::kSet},     {3, MatchPhase::kPlaying}, {4, MatchPhase::kFinished}};
  for (const auto& [state, phase] : phases) {
    packet_.state = static_cast<uint8_t>(state);
    say(packet_);
    EXPECT_EQ(referee_.state().phase, phase);
  }
  packet_.first_half = 0;
  packet_.seconds = 412;
  packet_.kicking_team = 12;
  say(packet_);
  EXPECT_EQ(referee_.state().half, 2);
  EXPECT_EQ(referee_.state().time_left, 412);
  EXPECT_EQ(referee_.state().kickoff_team, 1);
  packet_.seconds = -3;
  say(packet_);
  EXPECT_EQ(referee_.state().time_left, 0);
}

TEST_F(GameControllerRefereeTest, CountsEveryGoalOnceAndTakesItBack) {
  packet_.state = 3;
  say(packet_);
  packet_.scores = {1, 2};
  EXPECT_THAT(kinds(say(packet_)),
              ElementsAre(MatchEventKind::kGoal, MatchEventKind::kGoal, MatchEventKind::kGoal));
  EXPECT_THAT(referee_.state().score, ElementsAre(1, 2));
  EXPECT_THAT(kinds(say(packet_)), ElementsAre());
  packet_.scores = {1, 1};
  EXPECT_THAT(kinds(say(packet_)), ElementsAre());
  EXPECT_THAT(referee_.state().score, ElementsAre(1, 1));
  EXPECT_EQ(referee_.state().event.id, 3);
}

TEST_F(GameControllerRefereeTest, PutsBallAndRobotsForTheKickOff) {
  input_.robots[1].position = {1, 1};  // A2 in the other half
  packet_.state = 1;
  EXPECT_TRUE(say(packet_).placements.empty());
  packet_.state = 2;
  const RefereeOutput output = say(packet_);
  ASSERT_EQ(output.placements.size(), 2u);
  EXPECT_EQ(output.placements[0].robot, "A2");
  EXPECT_LT(output.placements[0].pose.position.x(), 0);
  EXPECT_EQ(output.placements[1].robot, "");
  EXPECT_EQ(output.placements[1].pose.position.norm(), 0);
  packet_.state = 3;
  EXPECT_THAT(kinds(say(packet_)), ElementsAre(MatchEventKind::kKickOff));
}

TEST_F(GameControllerRefereeTest, PutsPenalisedRobotsBesideTheField) {
  packet_.state = 3;
  say(packet_);
  packet_.penalties[1][0] = {6, 45};
  const RefereeOutput output = say(packet_);
  ASSERT_EQ(output.placements.size(), 1u);
  EXPECT_EQ(output.placements[0].robot, "B1");
  EXPECT_GT(output.placements[0].pose.position.y(), 3);
  EXPECT_EQ(output.events.at(0).robot, "B1");
  EXPECT_EQ(referee_.state().players[2].penalty, Penalty::kLeftField);
  EXPECT_EQ(referee_.state().players[2].penalty_left, 45);
  // A changed penalty does not count as one that has just begun.
  packet_.penalties[1][0] = {2, 44};
  EXPECT_TRUE(say(packet_).placements.empty());
  packet_.penalties[1][0] = {0, 0};
  EXPECT_THAT(kinds(say(packet_)), ElementsAre(MatchEventKind::kPenaltyEnd));
  EXPECT_EQ(referee_.state().players[2].penalty, Penalty::kNone);
}

TEST_F(GameControllerRefereeTest, PutsTheBallForSetPlays) {
  packet_.state = 3;
  say(packet_);
  const auto ball_at = [&](uint8_t set_play, uint8_t team) {
    packet_.set_play = 0;
    say(packet_);
    packet_.set_play = set_play;
    packet_.kicking_team = team;
    const RefereeOutput output = say(packet_);
    return output.placements.empty() ? Eigen::Vector2d(99, 99)
                                     : output.placements.at(0).pose.position;
  };
  const FieldDimensions field = *SceneFile::find("soccer").field;
  const double x = 0.5 * field.length;
  const double y = 0.5 * field.width;
  input_.ball = {1, -y - 0.2, 0.05};
  EXPECT_TRUE(ball_at(4, 5).isApprox(Eigen::Vector2d(1, -y)));
  input_.ball = {x + 0.3, 2, 0.05};
  EXPECT_TRUE(ball_at(3, 5).isApprox(Eigen::Vector2d(x, y))) << "corner of the attacked side";
  EXPECT_TRUE(ball_at(1, 12).isApprox(
      Eigen::Vector2d(x - field.goal_area_length, 0.5 * field.goal_area_width)));
  EXPECT_TRUE(ball_at(5, 12).isApprox(Eigen::Vector2d(-x + field.penalty_mark_distance, 0)));
  EXPECT_EQ(ball_at(2, 5).x(), 99) << "a free kick is taken where the ball is";
  packet_.set_play = 0;
  EXPECT_THAT(kinds(say(packet_)), ElementsAre(MatchEventKind::kBallFree));
}

TEST_F(GameControllerRefereeTest, RobotsStandWhilePlayIsStopped) {
  packet_.version = 20;
  for (packet_.state = 1; packet_.state < 3; ++packet_.state) say(packet_);
  EXPECT_THAT(kinds(say(packet_)), ElementsAre(MatchEventKind::kKickOff));
  packet_.stopped = 1;
  RefereeOutput output = say(packet_);
  EXPECT_EQ(referee_.state().phase, MatchPhase::kSet);
  EXPECT_TRUE(output.placements.empty()) << "no kick-off is prepared";
  packet_.stopped = 0;
  output = say(packet_);
  EXPECT_EQ(referee_.state().phase, MatchPhase::kPlaying);
  EXPECT_TRUE(output.events.empty()) << "no kick-off has happened";
  // A stop before the kick-off does not hide the kick-off.
  packet_.state = 1;
  packet_.stopped = 1;
  say(packet_);
  EXPECT_EQ(referee_.state().phase, MatchPhase::kSet);
  packet_.state = 2;
  packet_.stopped = 0;
  EXPECT_FALSE(say(packet_).placements.empty());
}

TEST_F(GameControllerRefereeTest, TeamsAreFoundByTheirNumbers) {
  GameControllerReferee referee(players(), SceneFile::find("soccer"), {{12, 5}}, 1);
  packet_.scores = {3, 0};
  ASSERT_TRUE(referee.concerns(decode_game_controller(packet_.bytes())));
  referee.receive(decode_game_controller(packet_.bytes()));
  EXPECT_EQ(referee.team_number(0), 12);
  referee.step(input_);
  EXPECT_THAT(referee.state().score, ElementsAre(0, 3));
  packet_.team_numbers = {5, 13};
  EXPECT_FALSE(referee.concerns(decode_game_controller(packet_.bytes())));
}

TEST_F(GameControllerRefereeTest, TeamsStayTheSameWhenTheirOrderChangesAtHalfTime) {
  packet_.scores = {2, 0};
  say(packet_);
  packet_.team_numbers = {12, 5};
  packet_.scores = {1, 2};
  EXPECT_THAT(kinds(say(packet_)), ElementsAre(MatchEventKind::kGoal));
  EXPECT_THAT(referee_.state().score, ElementsAre(2, 1));
}

TEST_F(GameControllerRefereeTest, IsNotOverruled) {
  EXPECT_EQ(referee_.overrule({MatchOperation::kStart, 0, ""})->code, "match-by-game-controller");
}

}  // namespace
}  // namespace nao::referee
