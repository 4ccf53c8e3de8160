#include "phone-gateway/secure_channel/secure_channel.h"

#include <gtest/gtest.h>

#include <fstream>

#include "common/error.h"
#include "common/json_text.h"
#include "phone-gateway/secure_channel/hexadecimal.h"

namespace nao {
namespace {

std::string from_hex(const std::string& digits) {
  return nao::from_hex(digits, digits.size() / 2).value();
}

/** The vectors that the app's tests read too; made with Node's crypto module, not with this code.
 */
class SecureChannelVectors : public testing::Test {
 protected:
  std::string bytes(const char* name) const { return from_hex(vectors_.at(name)); }

  SecureChannel phone() const {
    const EphemeralKey key(bytes("phone_key"));
    const std::string public_key = bytes("answer").substr(1, kPublicKeyBytes);
    return {SecureChannel::Side::kPhone, key.agree(public_key).value(), bytes("secret"),
            bytes("hello"), public_key};
  }

  nlohmann::json vectors_ = [] {
    std::ifstream file(SECURE_CHANNEL_VECTORS);
    return parse_json(std::string(std::istreambuf_iterator<char>(file), {}));
  }();
};

TEST_F(SecureChannelVectors, BothSidesAgreeOnKeysAndFrames) {
  EXPECT_EQ(hello_invitation(bytes("hello")), bytes("invitation"));
  EXPECT_EQ(EphemeralKey(bytes("phone_key")).agree(EphemeralKey(bytes("gateway_key")).public_key()),
            bytes("shared"));
  auto gateway = answer_hello(EphemeralKey(bytes("gateway_key")), bytes("hello"), bytes("secret"));
  ASSERT_TRUE(gateway);
  EXPECT_EQ(gateway->answer, bytes("answer"));
  SecureChannel phone = this->phone();
  EXPECT_EQ(phone.open(gateway->answer.substr(1 + kPublicKeyBytes)).fault, FrameFault::kNone);
  for (const auto& vector : vectors_.at("frames")) {
    const bool is_of_phone = vector.at("from") == "phone";
    SecureChannel& sender = is_of_phone ? phone : gateway->channel;
    SecureChannel& receiver = is_of_phone ? gateway->channel : phone;
    const std::string text = from_hex(vector.at("text"));
    const std::string frame = sender.seal(text);
    EXPECT_EQ(frame, from_hex(vector.at("frame")));
    const OpenedFrame opened = receiver.open(frame);
    EXPECT_EQ(opened.fault, FrameFault::kNone);
    EXPECT_EQ(opened.text, text);
  }
}

TEST_F(SecureChannelVectors, EveryChangedBitIsNoticed) {
  const std::string frame = phone().seal("walk");
  auto gateway = answer_hello(EphemeralKey(bytes("gateway_key")), bytes("hello"), bytes("secret"));
  for (size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    std::string changed = frame;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
    const OpenedFrame opened = gateway->channel.open(changed);
    EXPECT_NE(opened.fault, FrameFault::kNone) << bit;
    EXPECT_TRUE(opened.text.empty());
  }
  EXPECT_EQ(gateway->channel.open(frame).text, "walk");
}

TEST_F(SecureChannelVectors, ReplayedReorderedAndShortenedFramesAreRefusedWithTheirReason) {
  SecureChannel phone = this->phone();
  auto gateway = answer_hello(EphemeralKey(bytes("gateway_key")), bytes("hello"), bytes("secret"));
  const std::string first = phone.seal("first");
  const std::string second = phone.seal("second");
  EXPECT_EQ(gateway->channel.open(second).fault, FrameFault::kOutOfOrder);
  EXPECT_EQ(gateway->channel.open(first).fault, FrameFault::kNone);
  EXPECT_EQ(gateway->channel.open(first).fault, FrameFault::kReplayed);
  EXPECT_EQ(gateway->channel.open(second.substr(0, kFrameOverheadBytes - 1)).fault,
            FrameFault::kTooShort);
  EXPECT_EQ(gateway->channel.open(second.substr(0, second.size() - 1)).fault,
            FrameFault::kTampered);
  // A frame of the own direction sent back.
  EXPECT_EQ(phone.open(first).fault, FrameFault::kTampered);
  for (const FrameFault fault : {FrameFault::kTooShort, FrameFault::kReplayed,
                                 FrameFault::kOutOfOrder, FrameFault::kTampered}) {
    EXPECT_NE(std::string(describe(fault)), "");
  }
}

TEST_F(SecureChannelVectors, AFrameOfAnEarlierConnectionIsRefused) {
  const std::string recorded = phone().seal("walk");
  // The same hello again: the gateway's key is another one.
  auto gateway = answer_hello(EphemeralKey(), bytes("hello"), bytes("secret"));
  ASSERT_TRUE(gateway);
  EXPECT_EQ(gateway->channel.open(recorded).fault, FrameFault::kTampered);
}

TEST_F(SecureChannelVectors, WhoLacksTheSecretMakesNoFrame) {
  auto gateway = answer_hello(EphemeralKey(bytes("gateway_key")), bytes("hello"),
                              std::string(kInvitationSecretBytes, 'x'));
  EXPECT_EQ(gateway->channel.open(phone().seal("walk")).fault, FrameFault::kTampered);
  EXPECT_EQ(phone().open(gateway->channel.seal("state")).fault, FrameFault::kOutOfOrder);
  EXPECT_EQ(phone().open(gateway->answer.substr(1 + kPublicKeyBytes)).fault, FrameFault::kTampered);
}

TEST_F(SecureChannelVectors, AFrameTellsHowManyItsSenderHasReceived) {
  SecureChannel phone = this->phone();
  auto gateway = answer_hello(EphemeralKey(bytes("gateway_key")), bytes("hello"), bytes("secret"));
  EXPECT_EQ(gateway->channel.open(phone.seal("")).num_received_by_other, 0u);
  (void)phone.open(gateway->answer.substr(1 + kPublicKeyBytes));
  (void)phone.open(gateway->channel.seal(""));
  EXPECT_EQ(gateway->channel.open(phone.seal("")).num_received_by_other, 2u);
  EXPECT_EQ(gateway->channel.num_sealed(), 2u);
}

TEST_F(SecureChannelVectors, AWrongHelloIsRefused) {
  const std::string hello = bytes("hello");
  EXPECT_FALSE(hello_invitation(hello.substr(1)));
  EXPECT_FALSE(hello_invitation(hello + "x"));
  EXPECT_FALSE(hello_invitation("\x02" + hello.substr(1)));
  // No point of the curve.
  std::string off_curve = hello;
  off_curve.back() = static_cast<char>(off_curve.back() ^ 1);
  EXPECT_FALSE(answer_hello(EphemeralKey(), off_curve, bytes("secret")));
  EXPECT_THROW(EphemeralKey("no key"), Error);
}

}  // namespace
}  // namespace nao
