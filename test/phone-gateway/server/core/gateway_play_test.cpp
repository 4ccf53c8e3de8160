#include <gtest/gtest.h>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::Notice;
using naoremote::Play;

class GatewayPlay : public GatewayFixture {
 protected:
  naoremote::Response play(Client& client, Play::Behavior behavior) {
    naoremote::Request request;
    request.mutable_play()->set_behavior(behavior);
    return ask(client, request);
  }
  /** As nao-play answers a command. */
  void answer(const SentPlayCommand& command, ResultStatus status, const Reason& reason = {}) {
    core_->robot().handle_result({command.source, command.id, CommandKind::kPlay, status, reason},
                                 now_);
  }
  /** Time passes; nao-play answers what it gets, and the client pings once a second.
   * @param seconds  A whole number. */
  void run(Client& client, int seconds) {
    for (int i = 0; i < 10 * seconds; ++i) {
      if (i % 10 == 0) ping(client);
      const size_t before = plays_.size();
      pass(0.1);
      for (size_t k = before; k < plays_.size(); ++k) answer(plays_[k], ResultStatus::kAccepted);
    }
  }
  /** Ana plays: the command was accepted. */
  Client begin() {
    Client ana = connect_driver("Ana");
    EXPECT_EQ(play(ana, Play::SCORE).error(), naoremote::OK);
    answer(plays_.back(), ResultStatus::kAccepted);
    return ana;
  }
  /** The last command ends the behavior. */
  bool was_ended() const {
    return !plays_.empty() && plays_.back().command.behavior == Behavior::kNone;
  }
};

TEST_F(GatewayPlay, NeedsControlAndARobot) {
  Client ana = connect("Ana");
  EXPECT_EQ(play(ana, Play::SCORE).error(), naoremote::NO_CONTROL);
  Client ben = connect_driver("Ben");
  EXPECT_EQ(play(ana, Play::SCORE).error(), naoremote::CONTROL_TAKEN);
  has_robot_ = false;
  pass(2);
  ping(ben);
  EXPECT_EQ(play(ben, Play::SCORE).error(), naoremote::ROBOT_UNAVAILABLE);
  EXPECT_TRUE(plays_.empty());
}

TEST_F(GatewayPlay, RefusesWhatNaoPlayWouldRefuse) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(play(ana, static_cast<Play::Behavior>(77)).reason_code(), "behavior-unknown");
  naoremote::Request request;
  request.mutable_play()->set_behavior(Play::KICK);
  request.mutable_play()->set_target_x(1);
  EXPECT_EQ(ask(ana, request).reason_code(), "target-incomplete");
  request.mutable_play()->set_target_y(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(ask(ana, request).reason_code(), "target-out-of-range");
  EXPECT_TRUE(plays_.empty());
  request.mutable_play()->set_target_y(-2);
  EXPECT_EQ(ask(ana, request).error(), naoremote::OK);
  ASSERT_EQ(plays_.size(), 1u);
  EXPECT_EQ(plays_[0].command.target_in_odometry, (std::array<double, 2>{1, -2}));
}

TEST_F(GatewayPlay, IsRepeatedWhileTheDriverIsHeardOf) {
  Client ana = begin();
  const int64_t id = plays_.back().id;
  plays_.clear();
  run(ana, 20);
  EXPECT_GE(plays_.size(), 30u);
  for (const SentPlayCommand& each : plays_) {
    EXPECT_EQ(each.id, id);
    EXPECT_EQ(each.command.behavior, Behavior::kScore);
  }
  // A driver whose robot plays is not idle.
  Client ben = connect("Ben");
  EXPECT_EQ(take_control(ben).error(), naoremote::CONTROL_TAKEN);
}

TEST_F(GatewayPlay, EndsWhenTheDriverIsSilent) {
  Client ana = begin();
  run(ana, 2);
  plays_.clear();
  pass(2.2);
  EXPECT_TRUE(was_ended());
  plays_.clear();
  pass(2);
  EXPECT_TRUE(plays_.empty());
}

TEST_F(GatewayPlay, EndsAtOnceWithTheConnection) {
  Client ana = begin();
  core_->closed(ana.id, "gone", now_);
  EXPECT_TRUE(was_ended());
  const int64_t id = plays_.back().id;
  pass(1);
  // Three times: the bus may lose a message.
  EXPECT_EQ(std::count_if(plays_.begin(), plays_.end(),
                          [id](const SentPlayCommand& each) { return each.id == id; }),
            3);
}

TEST_F(GatewayPlay, EndsWithControlAndWithAnyStop) {
  Client ana = begin();
  naoremote::Request release;
  release.mutable_release_control();
  ask(ana, release);
  EXPECT_TRUE(was_ended());
  EXPECT_EQ(take_control(ana).error(), naoremote::OK);
  play(ana, Play::KEEP_GOAL);
  EXPECT_FALSE(was_ended());
  Client ben = connect("Ben");
  naoremote::Request stop;
  stop.mutable_stop();
  ask(ben, stop);
  EXPECT_TRUE(was_ended());
}

TEST_F(GatewayPlay, OnlyADeliberateReleaseLetsTheRobotPlayByItselfAgain) {
  const auto num_releases = [this] {
    return std::count_if(plays_.begin(), plays_.end(), [](const SentPlayCommand& each) {
      return each.command.behavior == Behavior::kAuto;
    });
  };
  naoremote::PlayState waiting;
  waiting.set_reason_code(kWaitsForRelease);
  naoremote::Request release;
  release.mutable_release_control();
  {
    Client ana = connect_driver("Ana");
    core_->robot().set_play_state(waiting);
    // Silence, and a lost connection.
    pass(20);
    core_->closed(ana.id, "gone", now_);
    pass(2);
    EXPECT_EQ(num_releases(), 0);
  }
  Client ben = connect_driver("Ben");
  ask(ben, release);
  // Another client drives before the release is sent.
  Client cleo = connect_driver("Cleo");
  pass(2);
  EXPECT_EQ(num_releases(), 0);
  ask(cleo, release);
  pass(2);
  EXPECT_EQ(num_releases(), 3) << "three times: the bus may lose a message";
  // A robot that does not play by itself is left alone.
  core_->robot().set_play_state({});
  plays_.clear();
  take_control(cleo);
  ask(cleo, release);
  pass(2);
  EXPECT_EQ(num_releases(), 0);
}

TEST_F(GatewayPlay, IsReplacedByAWalkWithoutAnEndOfItsOwn) {
  Client ana = begin();
  plays_.clear();
  naoremote::Request walk;
  walk.mutable_walk_turn()->set_vx(0.1);
  EXPECT_EQ(ask(ana, walk).error(), naoremote::OK);
  pass(0.4);
  // "None" could end the walk instead.
  EXPECT_TRUE(plays_.empty());
}

TEST_F(GatewayPlay, IsNotEndedByAReleasedJoystick) {
  Client ana = begin();
  naoremote::Request walk;
  walk.mutable_walk_turn();
  sent_.clear();
  EXPECT_EQ(ask(ana, walk).error(), naoremote::OK);
  run(ana, 1);
  EXPECT_TRUE(sent_.empty());
  EXPECT_FALSE(was_ended());
}

TEST_F(GatewayPlay, ReportsItsResults) {
  Client ana = begin();
  const SentPlayCommand score = plays_.back();
  run(ana, 1);
  answer(score, ResultStatus::kDone);
  auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].status(), Notice::ACCEPTED);
  EXPECT_EQ(results[1].status(), Notice::DONE);
  EXPECT_EQ(results[1].message(), "score: done.");
  plays_.clear();
  pass(1);
  EXPECT_TRUE(plays_.empty());
  play(ana, Play::NONE);
  EXPECT_TRUE(plays_.empty());
}

TEST_F(GatewayPlay, ReportsASilentProgram) {
  Client ana = connect_driver("Ana");
  play(ana, Play::SCORE);
  pass(1.7);
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status(), Notice::FAILED);
  EXPECT_EQ(results[0].reason_code(), "play-unanswered");
}

TEST_F(GatewayPlay, SendsPlayStateAndVisionToClientsThatAsk) {
  Client ana = connect("Ana");
  Client ben = connect("Ben");
  naoremote::Request request;
  request.mutable_subscribe()->set_play_state(true);
  request.mutable_subscribe()->set_vision(true);
  ask(ana, request);
  naoremote::PlayState state;
  state.set_phase(naoremote::PlayState::APPROACH);
  core_->robot().perception().set(state);
  naoremote::Vision vision;
  vision.set_camera("top");
  core_->robot().perception().set(vision);
  vision.set_camera("bottom");
  core_->robot().perception().set(vision);
  collect(ana);
  collect(ben);
  int num_states = 0;
  std::vector<std::string> cameras;
  for (const auto& message : ana.received) {
    if (message.has_play_state()) ++num_states;
    if (message.has_vision()) cameras.push_back(message.vision().camera());
  }
  EXPECT_EQ(num_states, 1);
  // The newest only.
  EXPECT_EQ(cameras, std::vector<std::string>{"bottom"});
  for (const auto& message : ben.received) {
    EXPECT_FALSE(message.has_play_state() || message.has_vision());
  }
}

}  // namespace
}  // namespace nao::gateway
