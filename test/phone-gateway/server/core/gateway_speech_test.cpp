#include <gtest/gtest.h>

#include "test/phone-gateway/server/core/gateway_fixture.h"

namespace nao::gateway {
namespace {

using naoremote::Notice;

class GatewaySpeech : public GatewayFixture {
 protected:
  naoremote::Response say(Client& client, const std::string& text,
                          const std::string& language = "") {
    naoremote::Request request;
    request.mutable_say()->set_text(text);
    request.mutable_say()->set_language(language);
    return ask(client, request);
  }
  naoremote::Response light(Client& client, const std::string& name, uint32_t rgb) {
    naoremote::Request request;
    request.mutable_set_lights()->add_light_names(name);
    request.mutable_set_lights()->add_light_rgb(rgb);
    return ask(client, request);
  }
  naoremote::Response subscribe_audio(Client& client, bool audio) {
    naoremote::Request request;
    request.mutable_subscribe()->set_audio(audio);
    return ask(client, request);
  }
  /** As nao-speaker or the robot answers the last command. */
  void answer(CommandKind kind, ResultStatus status, const Reason& reason = {}) {
    ASSERT_FALSE(services_.empty());
    const ServiceCommand& command = services_.back();
    core_->robot().handle_result({command.source, command.id, kind, status, reason}, now_);
  }
  std::vector<naoremote::Audio> audio(Client& client) {
    collect(client);
    std::vector<naoremote::Audio> found;
    for (const auto& message : client.received) {
      if (message.has_audio()) found.push_back(message.audio());
    }
    client.received.clear();
    return found;
  }
  static SpeechPiece piece(int64_t id, uint64_t first_sample, const std::string& samples) {
    return {"nao.1", id, 22050, first_sample, samples.empty(), samples};
  }
};

TEST_F(GatewaySpeech, NeedsControlButNoRobot) {
  has_robot_ = false;
  has_motion_ = false;
  pass(2);
  Client ana = connect("Ana");
  EXPECT_EQ(say(ana, "hello").error(), naoremote::NO_CONTROL);
  EXPECT_EQ(light(ana, "chest", 0xff0000).error(), naoremote::NO_CONTROL);
  Client ben = connect_driver("Ben");
  EXPECT_EQ(say(ana, "hello").error(), naoremote::CONTROL_TAKEN);
  EXPECT_TRUE(services_.empty());
  EXPECT_EQ(say(ben, "hello").error(), naoremote::OK);
  EXPECT_EQ(light(ben, "chest", 0xff0000).error(), naoremote::OK);
  EXPECT_EQ(services_.size(), 2u);
}

TEST_F(GatewaySpeech, KeepsControlByASpeechCommand) {
  Client ana = connect_driver("Ana");
  Client ben = connect("Ben");
  for (int i = 0; i < 4; ++i) {
    for (int second = 0; second < 4; ++second) {
      pass(1);
      ping(ana);
      ping(ben);
    }
    say(ana, "hello");
    answer(CommandKind::kSpeech, ResultStatus::kDone);
    EXPECT_EQ(take_control(ben).error(), naoremote::CONTROL_TAKEN);
  }
}

TEST_F(GatewaySpeech, PassesOnTheTextAndReportsItsResults) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(say(ana, "Guten Tag", "de-AT").error(), naoremote::OK);
  ASSERT_EQ(services_.size(), 1u);
  const auto& command = std::get<SpeechCommand>(services_[0].request);
  EXPECT_EQ(command.text, "Guten Tag");
  EXPECT_EQ(command.language, "de-AT");
  EXPECT_EQ(command.volume, 1);
  EXPECT_EQ(command.rate, 1);
  answer(CommandKind::kSpeech, ResultStatus::kAccepted);
  answer(CommandKind::kSpeech, ResultStatus::kInterrupted, Reason("speech-stopped"));
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].status(), Notice::ACCEPTED);
  EXPECT_EQ(results[1].status(), Notice::INTERRUPTED);
  EXPECT_EQ(results[1].reason_code(), "speech-stopped");
  EXPECT_EQ(results[1].message(), "The speech was stopped.");
  EXPECT_EQ(results[1].request_id(), ana.last_request_id);
}

TEST_F(GatewaySpeech, RefusesTextsThatTheSpeakerWouldRefuse) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(say(ana, "").reason_code(), "text-missing");
  EXPECT_EQ(say(ana, std::string(1001, 'a')).reason_code(), "text-too-long");
  EXPECT_EQ(say(ana, "a\x01").reason_code(), "text-control-character");
  EXPECT_EQ(say(ana, "a", "xx").reason_code(), "language-unknown");
  naoremote::Request request;
  request.mutable_say()->set_text("a");
  request.mutable_say()->set_volume(2);
  EXPECT_EQ(ask(ana, request).reason_code(), "volume-out-of-range");
  EXPECT_TRUE(services_.empty());
}

TEST_F(GatewaySpeech, RepeatsACommandAndReportsASilentSpeaker) {
  Client ana = connect_driver("Ana");
  say(ana, "hello");
  pass(1);
  EXPECT_GE(services_.size(), 8u);
  for (const ServiceCommand& command : services_) EXPECT_EQ(command.id, services_[0].id);
  pass(1);
  const auto results = notices(ana, Notice::COMMAND_RESULT);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].status(), Notice::FAILED);
  EXPECT_EQ(results[0].reason_code(), "speech-unanswered");
}

TEST_F(GatewaySpeech, SetsLightsByNameAndColor) {
  Client ana = connect_driver("Ana");
  EXPECT_EQ(light(ana, "chest", 0xff0033).error(), naoremote::OK);
  const auto& command = std::get<LightCommand>(services_.back().request);
  EXPECT_EQ(command.light_names, std::vector<std::string>{"chest"});
  EXPECT_EQ(command.light_rgb, (std::vector<LightColor>{{1, 0, 0.2}}));
  EXPECT_EQ(light(ana, "tail", 0).reason_code(), "light-unknown");
  EXPECT_EQ(light(ana, "chest", 0x1ffffff).reason_code(), "light-color-out-of-range");
  naoremote::Request request;
  request.mutable_set_lights()->add_light_names("chest");
  EXPECT_EQ(ask(ana, request).reason_code(), "light-lists-unequal");
  EXPECT_EQ(services_.size(), 1u);
}

TEST_F(GatewaySpeech, StatesHaveTheColorsOfTheLights) {
  Client ana = connect("Ana");
  core_->robot().streams().set_lights({0xff0000, 0x0000ff});
  naoremote::Request request;
  request.mutable_get_state();
  const auto state = ask(ana, request).state_and_image().state();
  ASSERT_EQ(state.light_rgb_size(), 2);
  EXPECT_EQ(state.light_rgb(0), 0xff0000u);
  EXPECT_EQ(state.light_rgb(1), 0x0000ffu);
}

TEST_F(GatewaySpeech, StatesHaveTheConditionOfTheBodyWhileTheRobotAnswers) {
  Client ana = connect("Ana");
  naoremote::Request request;
  request.mutable_get_state();
  EXPECT_FALSE(ask(ana, request).state_and_image().state().has_body());
  naoremote::Body body;
  body.set_battery_charge(0.5f);
  body.add_warnings("joint-hot");
  core_->robot().streams().set_body(body);
  const auto state = ask(ana, request).state_and_image().state();
  EXPECT_FLOAT_EQ(state.body().battery_charge(), 0.5f);
  ASSERT_EQ(state.body().warnings_size(), 1);
}

TEST_F(GatewaySpeech, SendsAudioToThoseWhoAskForIt) {
  Client ana = connect("Ana");
  Client ben = connect("Ben");
  EXPECT_EQ(subscribe_audio(ana, true).error(), naoremote::OK);
  EXPECT_EQ(subscribe_audio(ben, false).error(), naoremote::OK);
  core_->robot().streams().add_audio(piece(7, 0, "abcd"));
  core_->robot().streams().add_audio(piece(7, 2, "efgh"));
  core_->robot().streams().add_audio(piece(8, 0, "ijkl"));
  const auto pieces = audio(ana);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].samples(), "abcd");
  EXPECT_EQ(pieces[1].first_sample(), 2u);
  EXPECT_EQ(pieces[1].speech(), pieces[0].speech());
  EXPECT_EQ(pieces[2].speech(), pieces[0].speech() + 1);
  EXPECT_TRUE(audio(ben).empty());
}

TEST_F(GatewaySpeech, AStopRecallsTheAudioThatASlowClientHasNotReceived) {
  Client ana = connect("Ana");
  subscribe_audio(ana, true);
  for (int i = 0; i < 5; ++i) core_->robot().streams().add_audio(piece(7, i, "abcd"));
  core_->robot().streams().add_audio(piece(7, 2, ""));
  const auto pieces = audio(ana);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(pieces[0].is_last());
}

TEST_F(GatewaySpeech, ASlowClientsAudioIsBounded) {
  Client ana = connect("Ana");
  subscribe_audio(ana, true);
  for (int i = 0; i < 1000; ++i)
    core_->robot().streams().add_audio(piece(7, i, std::string(11000, 'a')));
  EXPECT_EQ(audio(ana).size(), Outbox::kMaxAudio);
}

}  // namespace
}  // namespace nao::gateway
