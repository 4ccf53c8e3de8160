#include "tools/foxglove/bus_relay.h"

#include <gtest/gtest.h>

#include <naolcm/command_result_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <nlohmann/json.hpp>

#include "common/data_path.h"
#include "common/json_text.h"

namespace nao::foxglove {
namespace {

using RelayJson = nlohmann::json;

template <class Message>
std::vector<uint8_t> bytes_of(const Message& message) {
  std::vector<uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

class BusRelayTest : public testing::Test {
 protected:
  BusRelayTest() {
    client_ = core_.open([] {});
  }

  /** Channels told to the client so far: number by topic. */
  std::map<std::string, uint32_t> channels() {
    while (const auto message = core_.next_message(client_)) {
      if (!message->is_text) continue;
      const RelayJson json = parse_json(message->head);
      if (json["op"] != "advertise") continue;
      for (const RelayJson& channel : json["channels"]) {
        channels_[channel["topic"]] = channel["id"];
        EXPECT_TRUE(parse_json(channel["schema"].get<std::string>()).is_object());
      }
    }
    return channels_;
  }
  void subscribe(uint32_t channel) {
    const RelayJson entry{{"id", channel}, {"channelId", channel}};
    core_.receive_text(client_, RelayJson{{"op", "subscribe"}, {"subscriptions", {entry}}}.dump());
  }

  const RobotModel model_ = RobotModel::load(data_path() / "robots" / "nao");
  ServerCore core_{"test", "1", {}, [](std::string_view) { return nullptr; }};
  FoxgloveConverter converter_{model_, "NAO"};
  BusRelay relay_{core_, converter_};
  uint32_t client_ = 0;
  std::map<std::string, uint32_t> channels_;
};

TEST_F(BusRelayTest, ChannelsOfTheBusAppearWithTheirFirstMessage) {
  EXPECT_TRUE(channels().contains("/NAO/transforms")) << "known before any message";
  EXPECT_FALSE(channels().contains("NAO_STOP_COMMAND"));
  naolcm::stop_command_t stop{};
  stop.source = "test";
  relay_.receive("NAO_STOP_COMMAND", bytes_of(stop), 5);
  ASSERT_TRUE(channels().contains("NAO_STOP_COMMAND"));
  // The message that made the channel known is not lost.
  subscribe(channels().at("NAO_STOP_COMMAND"));
  const auto message = core_.next_message(client_);
  ASSERT_TRUE(message && message->body);
  EXPECT_EQ(parse_json(*message->body)["source"], "test");
}

TEST_F(BusRelayTest, AChannelWhoseTypeChangesIsToldAnew) {
  relay_.receive("NAO_X", bytes_of(naolcm::stop_command_t{}), 5);
  const uint32_t before = channels().at("NAO_X");
  relay_.receive("NAO_X", bytes_of(naolcm::command_result_t{}), 6);
  EXPECT_NE(channels().at("NAO_X"), before);
}

TEST_F(BusRelayTest, CountsWhatItCannotDecode) {
  relay_.receive("NAO_X", std::vector<uint8_t>{1, 2, 3}, 5);
  EXPECT_EQ(relay_.num_undecodable(), 1);
  auto damaged = bytes_of(naolcm::stop_command_t{});
  relay_.receive("NAO_STOP_COMMAND", damaged, 5);
  subscribe(channels().at("NAO_STOP_COMMAND"));
  damaged.pop_back();
  relay_.receive("NAO_STOP_COMMAND", damaged, 5);
  EXPECT_EQ(relay_.num_undecodable(), 2);
}

TEST_F(BusRelayTest, KnowsWhichCamerasAreWatched) {
  EXPECT_TRUE(relay_.wanted_cameras().empty());
  subscribe(channels().at("/NAO/camera/top/calibration"));
  EXPECT_EQ(relay_.wanted_cameras(), std::set<std::string>{"top"});
}

}  // namespace
}  // namespace nao::foxglove
