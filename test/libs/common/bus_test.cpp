#include "common/bus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <stdexcept>
#include <vector>

#include "common/error.h"

namespace nao {
namespace {

TEST(Bus, DeliversACompleteMessage) {
  Bus bus("memq://");
  naolcm::posture_command_t received;
  bus.subscribe<naolcm::posture_command_t>(
      "POSTURE", Bus::Queue::kAll,
      [&](const naolcm::posture_command_t& message) { received = message; });
  naolcm::posture_command_t sent;
  sent.wall_utime = 1;
  sent.source = "test";
  sent.command_id = 7;
  sent.posture = "Crouch";
  sent.speed = 0.5;
  bus.publish("POSTURE", sent);
  ASSERT_TRUE(bus.handle_for(1.0));
  EXPECT_EQ(received.posture, "Crouch");
  EXPECT_EQ(received.command_id, 7);
  EXPECT_EQ(received.speed, 0.5);
  EXPECT_EQ(bus.counters().num_in, 1);
  EXPECT_EQ(bus.counters().num_out, 1);
}

TEST(Bus, DropsAndCountsAMessageOfAnotherType) {
  Bus bus("memq://");
  int num_received = 0;
  bus.subscribe<naolcm::posture_command_t>(
      "POSTURE", Bus::Queue::kAll, [&](const naolcm::posture_command_t&) { ++num_received; });
  naolcm::stop_command_t other;
  other.wall_utime = 0;
  other.command_id = 1;
  bus.publish("POSTURE", other);
  bus.handle_for(1.0);
  EXPECT_EQ(num_received, 0);
  EXPECT_EQ(bus.counters().num_dropped, 1);
}

/** Bytes that are sent as a message. */
struct EncodedMessage {
  std::vector<uint8_t> bytes;
  // NOLINTNEXTLINE(readability-identifier-naming): called by Bus as lcm-gen names it.
  int getEncodedSize() const { return static_cast<int>(bytes.size()); }
  int encode(void* buffer, int /*offset*/, int size) const {
    std::copy_n(bytes.begin(), size, static_cast<uint8_t*>(buffer));
    return size;
  }
};

TEST(Bus, DropsAMessageWithATextOfLengthZero) {
  Bus bus("memq://");
  bus.subscribe<naolcm::stop_command_t>("STOP", Bus::Queue::kAll,
                                        [](const naolcm::stop_command_t&) {});
  const naolcm::stop_command_t message{};
  EncodedMessage damaged{std::vector<uint8_t>(message.getEncodedSize())};
  message.encode(damaged.bytes.data(), 0, damaged.getEncodedSize());
  // The length of `source` comes after fingerprint, utime and wall_utime, and counts the final
  // zero: LCM's decoder throws std::length_error for 0.
  damaged.bytes.at(8 + 8 + 8 + 3) = 0;
  bus.publish("STOP", damaged);
  bus.handle_for(1.0);
  EXPECT_EQ(bus.counters().num_dropped, 1);
}

TEST(Bus, DropsAMessageThatIsShorterThanItsList) {
  Bus bus("memq://");
  int num_received = 0;
  bus.subscribe<naolcm::joint_command_t>("JOINTS", Bus::Queue::kAll,
                                         [&](const naolcm::joint_command_t&) { ++num_received; });
  const naolcm::joint_command_t message{};
  EncodedMessage damaged{std::vector<uint8_t>(message.getEncodedSize())};
  message.encode(damaged.bytes.data(), 0, damaged.getEncodedSize());
  // num_joints comes after fingerprint, utime and tick. With 2^29 + 1 the number of bytes of a list
  // of doubles exceeds an int.
  damaged.bytes.at(8 + 8 + 8) = 0x20;
  damaged.bytes.at(8 + 8 + 8 + 3) = 1;
  bus.publish("JOINTS", damaged);
  bus.handle_for(1.0);
  EXPECT_EQ(num_received, 0);
  EXPECT_EQ(bus.counters().num_dropped, 1);
}

TEST(Bus, NoDamagedByteEndsTheProgram) {
  Bus bus("memq://");
  bus.subscribe<naolcm::joint_change_command_t>("JOINTS", Bus::Queue::kAll,
                                                [](const naolcm::joint_change_command_t&) {});
  naolcm::joint_change_command_t message{};
  message.num_joints = 2;
  message.joint_names = {"HeadYaw", "HeadPitch"};
  message.joint_position = {1, 2};
  message.joint_stiffness = {1, 1};
  EncodedMessage good{std::vector<uint8_t>(message.getEncodedSize())};
  message.encode(good.bytes.data(), 0, good.getEncodedSize());
  for (size_t i = 0; i < good.bytes.size(); ++i) {
    for (const uint8_t value : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
      EncodedMessage damaged = good;
      damaged.bytes[i] = value;
      bus.publish("JOINTS", damaged);
      ASSERT_NO_THROW(bus.handle()) << i;
    }
    EncodedMessage cut{{good.bytes.begin(), good.bytes.begin() + static_cast<long>(i)}};
    bus.publish("JOINTS", cut);
    ASSERT_NO_THROW(bus.handle()) << i;
  }
}

TEST(Bus, DropsAMessageThatItsHandlerFindsInvalid) {
  Bus bus("memq://");
  bus.subscribe<naolcm::stop_command_t>(
      "STOP", Bus::Queue::kAll, [](const auto&) { throw MessageError("its source is missing"); });
  bus.publish("STOP", naolcm::stop_command_t{});
  bus.handle_for(1.0);
  EXPECT_EQ(bus.counters().num_dropped, 1);
}

TEST(Bus, PassesOnAnyOtherExceptionOfAHandler) {
  Bus bus("memq://");
  int num_handled = 0;
  bus.subscribe<naolcm::stop_command_t>("STOP", Bus::Queue::kAll,
                                        [](const auto&) { throw std::out_of_range("a mistake"); });
  bus.subscribe_raw(".*", [&](const RawMessage&) { ++num_handled; });
  bus.publish("STOP", naolcm::stop_command_t{});
  EXPECT_THROW(bus.handle_for(1.0), std::out_of_range);
  EXPECT_EQ(num_handled, 0) << "the program ends at once";
  EXPECT_EQ(bus.counters().num_dropped, 0);
}

// LCM refuses it in the same way as where a firewall drops the bus's messages.
TEST(Bus, SaysWhatToDoIfItCannotSubscribe) {
  Bus bus("memq://");
  try {
    bus.subscribe_raw("(", [](const RawMessage&) {});
    FAIL() << "it subscribed";
  } catch (const BusError& error) {
    EXPECT_NE(std::string(error.what()).find("memq://"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("firewall"), std::string::npos);
  }
}

TEST(Bus, SaysWhatIsWrongWithAnAddressItCannotOpen) {
  EXPECT_THROW(Bus("nonsense://here"), BusError);
}

}  // namespace
}  // namespace nao
