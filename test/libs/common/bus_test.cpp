#include "common/bus.h"

#include <gtest/gtest.h>

#include <cstring>
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
    std::memcpy(buffer, bytes.data(), size);
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

TEST(Bus, SurvivesAHandlerThatThrows) {
  Bus bus("memq://");
  bus.subscribe<naolcm::stop_command_t>(
      "STOP", Bus::Queue::kAll,
      [](const naolcm::stop_command_t&) { throw std::runtime_error("no"); });
  naolcm::stop_command_t message;
  message.wall_utime = 0;
  message.command_id = 1;
  bus.publish("STOP", message);
  bus.handle_for(1.0);
  EXPECT_EQ(bus.counters().num_dropped, 1);
}

TEST(Bus, SaysWhatIsWrongWithAnAddressItCannotOpen) {
  EXPECT_THROW(Bus("nonsense://here"), BusError);
}

}  // namespace
}  // namespace nao
