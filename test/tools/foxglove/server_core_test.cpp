#include "tools/foxglove/server_core.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "common/json_text.h"

namespace nao::foxglove {
namespace {

using CoreJson = nlohmann::json;

class ServerCoreTest : public testing::Test {
 protected:
  static std::shared_ptr<const std::string> asset(std::string_view uri) {
    return uri == "package://robot/robot.urdf" ? std::make_shared<const std::string>("<robot/>")
                                               : nullptr;
  }
  uint32_t open() {
    return core_.open([this] { ++num_wakes_; });
  }
  /** The texts that wait for a client; binary messages as their bytes. */
  std::vector<std::string> received(uint32_t client) {
    std::vector<std::string> messages;
    while (auto message = core_.next_message(client)) {
      messages.push_back(message->head + (message->body ? *message->body : ""));
    }
    return messages;
  }
  void subscribe(uint32_t client, uint32_t id, uint32_t channel) {
    const CoreJson entry{{"id", id}, {"channelId", channel}};
    core_.receive_text(client, CoreJson{{"op", "subscribe"}, {"subscriptions", {entry}}}.dump());
  }

  ServerCore core_{"test", "1", {2, 1000}, asset};
  int num_wakes_ = 0;
};

TEST_F(ServerCoreTest, IntroducesItselfAndItsChannels) {
  core_.add_channel("A", "a", "{}");
  const uint32_t client = open();
  auto messages = received(client);
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(parse_json(messages[0])["op"], "serverInfo");
  EXPECT_EQ(parse_json(messages[1])["channels"][0]["topic"], "A");
  core_.add_channel("B", "b", "{}");
  messages = received(client);
  ASSERT_EQ(messages.size(), 1u) << "a new channel is told to those who are there";
  EXPECT_EQ(parse_json(messages[0])["channels"][0]["topic"], "B");
}

TEST_F(ServerCoreTest, SendsAChannelToItsSubscribersUnderTheirNumbers) {
  const uint32_t channel = core_.add_channel("A", "a", "{}");
  const uint32_t first = open();
  const uint32_t second = open();
  EXPECT_FALSE(core_.has_subscribers(channel));
  subscribe(first, 7, channel);
  EXPECT_TRUE(core_.has_subscribers(channel));
  received(first);
  received(second);
  core_.publish(channel, 5, "content");
  EXPECT_EQ(received(first), std::vector{message_header(7, 5) + "content"});
  EXPECT_TRUE(received(second).empty());
  core_.receive_text(first, R"({"op":"unsubscribe","subscriptionIds":[7]})");
  EXPECT_FALSE(core_.has_subscribers(channel));
  subscribe(second, 7, channel);
  core_.close(second);
  EXPECT_FALSE(core_.has_subscribers(channel));
}

TEST_F(ServerCoreTest, RefusesWhatItCannotDo) {
  const uint32_t channel = core_.add_channel("A", "a", "{}");
  const uint32_t client = open();
  subscribe(client, 1, channel);
  received(client);
  subscribe(client, 2, 99);
  subscribe(client, 1, channel);
  subscribe(client, 2, channel);
  core_.receive_text(client, R"({"op":"unsubscribe","subscriptionIds":[5]})");
  core_.receive_text(client, "nonsense");
  core_.receive_binary(client, "\1....");
  const auto messages = received(client);
  EXPECT_EQ(messages.size(), 6u);
  for (const std::string& message : messages) {
    EXPECT_EQ(parse_json(message)["op"], "status") << message;
  }
  EXPECT_EQ(core_.counters().num_refused, 6);
}

TEST_F(ServerCoreTest, LimitsClients) {
  open();
  const uint32_t second = open();
  EXPECT_EQ(open(), 0u);
  core_.close(second);
  EXPECT_NE(open(), 0u);
}

TEST_F(ServerCoreTest, AStalledClientDoesNotCostMoreThanItsLimit) {
  const uint32_t channel = core_.add_channel("A", "a", "{}");
  const uint32_t stalled = open();
  const uint32_t other = open();
  received(stalled);
  received(other);
  subscribe(stalled, 1, channel);
  subscribe(other, 1, channel);
  for (int i = 0; i < 1000; ++i) {
    core_.publish(channel, i, std::string(100, 'x'));
    EXPECT_EQ(received(other).size(), 1u);
  }
  EXPECT_FALSE(core_.must_close(stalled));
  const auto messages = received(stalled);
  EXPECT_LE(messages.size(), Outbox::kMaxWaiting);
  EXPECT_EQ(messages.back(), message_header(1, 999) + std::string(100, 'x')) << "the newest";
  for (int i = 0; i < 100; ++i) core_.receive_text(stalled, "nonsense");
  EXPECT_TRUE(core_.must_close(stalled)) << "it asks without reading the answers";
  EXPECT_FALSE(core_.must_close(other));
}

TEST_F(ServerCoreTest, SendsFiles) {
  const uint32_t client = open();
  received(client);
  core_.receive_text(client,
                     R"({"op":"fetchAsset","uri":"package://robot/robot.urdf","requestId":3})");
  core_.receive_text(client, R"({"op":"fetchAsset","uri":"file:///etc/passwd","requestId":4})");
  const auto messages = received(client);
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0], asset_header(3) + "<robot/>");
  EXPECT_EQ(messages[1][5], 1) << "status: an error";
}

TEST_F(ServerCoreTest, SurvivesRandomRequests) {
  const std::vector<std::string> parts{
      "{",    "}",   "\"op\":", "\"subscribe\"",  "\"unsubscribe\"",    "\"fetchAsset\"",
      "[",    "]",   "\"id\":", "\"channelId\":", "\"subscriptions\":", "\"subscriptionIds\":",
      "1",    "2",   ",",       "\"uri\":",       "\"requestId\":",     "-1e99",
      "\xff", "null"};
  core_.add_channel("A", "a", "{}");
  std::mt19937 random(1);
  uint32_t client = open();
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (int i = static_cast<int>(random() % 12); i >= 0; --i)
      text += parts[random() % parts.size()];
    core_.receive_text(client, text);
    core_.publish(1, round, "x");
    for (const std::string& message : received(client)) EXPECT_FALSE(message.empty());
    if (round % 1000 == 0) {
      core_.close(client);
      client = open();
    }
  }
}

}  // namespace
}  // namespace nao::foxglove
