#include "tools/foxglove/client_publisher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <nlohmann/json.hpp>

#include "common/json_text.h"
#include "inspection/message_from_json.h"
#include "inspection/message_json.h"
#include "tools/foxglove/server_core.h"

namespace nao::foxglove {
namespace {

class ClientPublisherTest : public testing::Test {
 protected:
  /** The last message that was sent. */
  template <class Message>
  Message sent() {
    Message message{};
    const int size = static_cast<int>(bytes_.size());
    EXPECT_EQ(message.decode(bytes_.data(), 0, size), size);
    return message;
  }

  int64_t utime_ = 1'000'000;
  std::string channel_;
  std::vector<uint8_t> bytes_;
  ClientPublisher publisher_{"nao-foxglove", "NAO", [this] { return utime_; },
                             [] { return int64_t{7}; },
                             [this](const std::string& channel, std::span<const uint8_t> message) {
                               channel_ = channel;
                               bytes_.assign(message.begin(), message.end());
                             }};
};

TEST_F(ClientPublisherTest, SendsCommandsWithSenderAndTime) {
  EXPECT_EQ(publisher_.publish(3, "NAO_POSTURE_COMMAND", R"({"posture":"Sit","speed":0.5})"), "");
  EXPECT_EQ(channel_, "NAO_POSTURE_COMMAND");
  const auto posture = sent<naolcm::posture_command_t>();
  EXPECT_EQ(posture.posture, "Sit");
  EXPECT_EQ(posture.speed, 0.5);
  EXPECT_EQ(posture.source, "nao-foxglove.3");
  EXPECT_EQ(posture.wall_utime, utime_);
  EXPECT_EQ(posture.utime, 7);
  // Each is a command of its own.
  EXPECT_EQ(publisher_.publish(3, "NAO_POSTURE_COMMAND", R"({"posture":"Sit"})"), "");
  EXPECT_NE(sent<naolcm::posture_command_t>().command_id, posture.command_id);
  EXPECT_EQ(publisher_.publish(3, "NAO_POSTURE_COMMAND", R"({"command_id":77})"), "");
  EXPECT_EQ(sent<naolcm::posture_command_t>().command_id, 77);
}

TEST_F(ClientPublisherTest, RepetitionsOfAWalkAreOneCommandUntilItEnds) {
  const auto walk = [&](uint32_t client) {
    EXPECT_EQ(publisher_.publish(client, "NAO_WALK_COMMAND", R"({"vx":0.1})"), "");
    EXPECT_EQ(sent<naolcm::walk_command_t>().vx, 0.1);
    return sent<naolcm::walk_command_t>().command_id;
  };
  const int64_t first = walk(1);
  EXPECT_NE(first, 0);
  utime_ += 400'000;
  EXPECT_EQ(walk(1), first);
  EXPECT_NE(walk(2), first);
  utime_ += 600'000;
  EXPECT_NE(walk(1), first) << "it ended 0.5 s after its last repetition";
}

TEST_F(ClientPublisherTest, AllowsCommandsOnly) {
  EXPECT_EQ(publisher_.check("NAO_WALK_COMMAND", "json"), "");
  EXPECT_EQ(publisher_.check("WORLD_COMMAND", "json"), "");
  EXPECT_NE(publisher_.check("NAO_WALK_COMMAND", "ros1"), "");
  for (const char* channel :
       {"NAO_JOINT_COMMAND", "NAO_SENSOR_STATE", "WORLD_TRUTH", "OTHER_WALK_COMMAND", ""}) {
    EXPECT_NE(publisher_.check(channel, "json"), "") << channel;
  }
}

TEST_F(ClientPublisherTest, SaysWhichFieldIsWrong) {
  const auto fault = [&](const char* channel, const char* json) {
    return publisher_.publish(1, channel, json);
  };
  EXPECT_EQ(fault("NAO_WALK_COMMAND", "{"), "The message is no JSON object.");
  EXPECT_EQ(fault("NAO_WALK_COMMAND", R"({"vz":1})"),
            "Field \"vz\" does not exist in walk_command_t.");
  EXPECT_EQ(fault("NAO_WALK_COMMAND", R"({"vx":"fast"})"), "Field \"vx\" is not a number.");
  EXPECT_EQ(fault("NAO_POSTURE_COMMAND", R"({"posture":1})"), "Field \"posture\" is not text.");
  EXPECT_EQ(fault("NAO_POSTURE_COMMAND", R"({"command_id":1.5})"),
            "Field \"command_id\" is not an integer.");
  EXPECT_EQ(fault("NAO_POSTURE_COMMAND", R"({"command_id":18446744073709551615})"),
            "Field \"command_id\" is out of range.");
  EXPECT_EQ(fault("WORLD_COMMAND", R"({"position_in_world":[1,2]})"),
            "Field \"position_in_world\" needs 3 entries.");
  EXPECT_TRUE(bytes_.empty()) << "nothing was sent";
}

TEST_F(ClientPublisherTest, TakesLengthsFromTheLists) {
  EXPECT_EQ(publisher_.publish(1, "WORLD_COMMAND", R"({"position_in_world":[1,2,3]})"), "");
  EXPECT_EQ(sent<naolcm::world_command_t>().position_in_world[2], 3);
  EXPECT_EQ(sent<naolcm::world_command_t>().velocity_in_world[2], 0);
  const nlohmann::json change{{"joint_names", {"A", "B"}}};
  const std::string fault = publisher_.publish(1, "NAO_JOINT_CHANGE_COMMAND", change.dump());
  EXPECT_NE(fault.find("needs 2 entries"), std::string::npos) << fault;
}

/** Every message of every type that message_to_json() writes is encoded to the same bytes. */
TEST(MessageFromJson, ReversesMessageToJson) {
  naolcm::joint_change_command_t change{};
  change.source = "a \"b\"";
  change.command_id = 5;
  change.joint_names = {"A", "B"};
  const size_t n = change.joint_names.size();
  std::vector<uint8_t> bytes;
  // The lists of the type, whatever they are called, through the layout: fill all with numbers.
  nlohmann::json object{{"source", change.source}, {"command_id", 5}};
  const MessageLayout& layout = *find_message_layout("joint_change_command_t");
  for (const FieldLayout& field : layout.fields) {
    if (field.dimensions.empty()) continue;
    for (size_t i = 0; i < n; ++i) {
      if (field.kind == FieldKind::kString) {
        object[field.name].push_back(change.joint_names[i]);
      } else if (field.kind == FieldKind::kBoolean) {
        object[field.name].push_back(i == 0);
      } else {
        object[field.name].push_back(i == 0 ? nlohmann::json(0.25) : nlohmann::json(nullptr));
      }
    }
  }
  const MessageType* type = nullptr;
  for (const MessageType& candidate : message_types()) {
    if (candidate.name == layout.name) type = &candidate;
  }
  const EncodedMessage encoded = message_from_json(*type, layout, object);
  ASSERT_EQ(encoded.fault, "");
  const auto json = message_to_json(layout, encoded.bytes);
  ASSERT_TRUE(json);
  const EncodedMessage again = message_from_json(*type, layout, parse_json(*json));
  EXPECT_EQ(again.fault, "");
  EXPECT_EQ(again.bytes, encoded.bytes);
}

/** Types whose every field has a default encode from nothing and decode again. */
TEST(MessageFromJson, EncodesEveryTypeFromNothing) {
  for (const MessageType& type : message_types()) {
    const EncodedMessage encoded =
        message_from_json(type, *find_message_layout(type.name), nlohmann::json::object());
    EXPECT_EQ(encoded.fault, "") << type.name;
    EXPECT_TRUE(type.decodes(encoded.bytes.data(), static_cast<int>(encoded.bytes.size())))
        << type.name;
  }
}

TEST_F(ClientPublisherTest, ServerPublishesOnlyWhenAllowed) {
  using std::string_literals::operator""s;
  ServerCore core("test", "1", {2, 10000}, [](std::string_view) { return nullptr; });
  const char* const advertise =
      R"({"op":"advertise","channels":[{"id":4,"topic":"NAO_WALK_COMMAND","encoding":"json"}]})";
  const std::string message = "\1\4\0\0\0"s + R"({"vx":0.1})";
  uint32_t client = core.open([] {});
  core.receive_text(client, advertise);
  core.receive_binary(client, message);
  EXPECT_EQ(core.counters().num_refused, 2);
  EXPECT_TRUE(bytes_.empty());
  core.close(client);
  core.allow_publishing(publisher_);
  client = core.open([] {});
  core.receive_binary(client, message);
  EXPECT_EQ(core.counters().num_refused, 3) << "not advertised";
  core.receive_text(client, advertise);
  core.receive_binary(client, message);
  EXPECT_EQ(core.counters().num_refused, 3);
  EXPECT_EQ(sent<naolcm::walk_command_t>().vx, 0.1);
  core.receive_text(client, R"({"op":"unadvertise","channelIds":[4]})");
  core.receive_binary(client, message);
  EXPECT_EQ(core.counters().num_refused, 4);
}

}  // namespace
}  // namespace nao::foxglove
