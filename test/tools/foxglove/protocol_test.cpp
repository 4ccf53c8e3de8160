#include "tools/foxglove/protocol.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/json_text.h"

namespace nao::foxglove {
namespace {

using Json = nlohmann::json;

std::string reason_of(const std::string& text) {
  const ClientRequest request = parse_client_text(text);
  const auto* refused = std::get_if<Refused>(&request);
  return refused == nullptr ? "" : refused->why;
}

TEST(Protocol, AgreesOnEitherSubprotocol) {
  EXPECT_EQ(choose_subprotocol("foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol("foxglove.websocket.v1, foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(choose_subprotocol("other,\tfoxglove.websocket.v1 "), "foxglove.websocket.v1");
  EXPECT_EQ(choose_subprotocol(""), std::nullopt);
  EXPECT_EQ(choose_subprotocol(","), std::nullopt);
  EXPECT_EQ(choose_subprotocol("foxglove.sdk.v2"), std::nullopt);
}

TEST(Protocol, ReadsRequests) {
  const auto subscribe = std::get<Subscribe>(parse_client_text(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":1,"channelId":5}]})"));
  ASSERT_EQ(subscribe.entries.size(), 2u);
  EXPECT_EQ(subscribe.entries[1].id, 1u);
  EXPECT_EQ(subscribe.entries[1].channel, 5u);
  const auto unsubscribe = std::get<Unsubscribe>(
      parse_client_text(R"({"op":"unsubscribe","subscriptionIds":[0,4294967295]})"));
  EXPECT_EQ(unsubscribe.ids, (std::vector<uint32_t>{0, 4294967295}));
  const auto asset = std::get<FetchAsset>(
      parse_client_text(R"({"op":"fetchAsset","uri":"package://robot/robot.urdf","requestId":7})"));
  EXPECT_EQ(asset.uri, "package://robot/robot.urdf");
  EXPECT_EQ(asset.request_id, 7u);
}

TEST(Protocol, SaysWhatIsWrongWithARequest) {
  EXPECT_EQ(reason_of("{"), "The text is no JSON object.");
  EXPECT_EQ(reason_of("[]"), "The text is no JSON object.");
  EXPECT_EQ(reason_of("{}"), "The message has no text \"op\".");
  EXPECT_EQ(reason_of(R"({"op":1})"), "The message has no text \"op\".");
  EXPECT_EQ(reason_of(R"({"op":"setParameters"})"),
            "This server does not support \"setParameters\".");
  EXPECT_NE(reason_of(R"({"op":"advertise"})"), "");
  EXPECT_NE(reason_of(R"({"op":"advertise","channels":[{"id":1}]})"), "");
  EXPECT_NE(reason_of(R"({"op":"advertise","channels":[{"id":-1,"topic":"A"}]})"), "");
  EXPECT_NE(reason_of(R"({"op":"unadvertise","channelIds":[-1]})"), "");
  EXPECT_NE(reason_of(R"({"op":"subscribe"})"), "");
  EXPECT_NE(reason_of(R"({"op":"subscribe","subscriptions":[1]})"), "");
  EXPECT_NE(reason_of(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":3}]})"), "");
  EXPECT_NE(reason_of(R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":3}]})"),
            "");
  EXPECT_NE(reason_of(R"({"op":"unsubscribe","subscriptionIds":["a"]})"), "");
  EXPECT_NE(reason_of(R"({"op":"fetchAsset","uri":3,"requestId":1})"), "");
  EXPECT_LT(reason_of(R"({"op":")" + std::string(5000, 'x') + "\"}").size(), 200u);
  for (const char* bytes : {"", "\1abc", "\2abcd"}) {
    EXPECT_TRUE(std::holds_alternative<Refused>(parse_client_binary(bytes))) << bytes;
  }
}

TEST(Protocol, ReadsWhatClientsPublish) {
  const auto advertise = std::get<Advertise>(parse_client_text(
      R"({"op":"advertise","channels":[{"id":2,"topic":"A","encoding":"json","schemaName":"x"}]})"));
  ASSERT_EQ(advertise.entries.size(), 1u);
  EXPECT_EQ(advertise.entries[0].id, 2u);
  EXPECT_EQ(advertise.entries[0].topic, "A");
  EXPECT_EQ(advertise.entries[0].encoding, "json");
  const auto end =
      std::get<Unadvertise>(parse_client_text(R"({"op":"unadvertise","channelIds":[2]})"));
  EXPECT_EQ(end.ids, std::vector<uint32_t>{2});
  using std::string_view_literals::operator""sv;
  const auto message = std::get<ClientMessage>(parse_client_binary("\1\2\1\0\0{}"sv));
  EXPECT_EQ(message.channel, 258u);
  EXPECT_EQ(message.content, "{}");
}

TEST(Protocol, WritesLittleEndianHeaders) {
  using std::string_literals::operator""s;
  EXPECT_EQ(message_header(0x04030201, 1), "\x01\x01\x02\x03\x04\xe8\x03\0\0\0\0\0\0"s);
  EXPECT_EQ(asset_header(5), "\x04\x05\0\0\0\0\0\0\0\0"s);
  EXPECT_EQ(asset_error(5, "no"), "\x04\x05\0\0\0\x01\x02\0\0\0no"s);
}

TEST(Protocol, DescribesChannels) {
  const Channel channel{3, "NAO_ROBOT_STATE", "naolcm.robot_state_t", R"({"type":"object"})"};
  const Json json = parse_json(advertise_text({&channel}));
  EXPECT_EQ(json["op"], "advertise");
  EXPECT_EQ(json["channels"][0]["id"], 3);
  EXPECT_EQ(json["channels"][0]["encoding"], "json");
  EXPECT_EQ(json["channels"][0]["schemaEncoding"], "jsonschema");
  EXPECT_EQ(json["channels"][0]["schema"], R"({"type":"object"})") << "a text, not an object";
  const Json info = parse_json(server_info_text("name", "1", false));
  EXPECT_EQ(info["capabilities"], Json::array({"assets"})) << "read-only";
  const Json open = parse_json(server_info_text("name", "1", true));
  EXPECT_EQ(open["capabilities"], Json::array({"assets", "clientPublish"}));
  EXPECT_EQ(open["supportedEncodings"], Json::array({"json"}));
}

}  // namespace
}  // namespace nao::foxglove
