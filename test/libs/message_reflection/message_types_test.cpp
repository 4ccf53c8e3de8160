#include "message_reflection/message_types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/image_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <naolcm/world_truth_t.hpp>
#include <set>
#include <vector>

namespace nao {
namespace {

std::vector<uint8_t> encoded_stop() {
  naolcm::stop_command_t command{};
  command.source = "test";
  command.command_id = 2;
  std::vector<uint8_t> bytes(command.getEncodedSize());
  command.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

TEST(MessageTypes, EveryLcmFileHasATypeWithItsOwnFingerprint) {
  std::set<int64_t> fingerprints;
  std::set<std::string> names;
  for (const MessageType& type : message_types()) {
    fingerprints.insert(type.fingerprint);
    names.insert(type.name);
  }
  size_t num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(NAO_LCMTYPES_DIR)) {
    if (entry.path().extension() != ".lcm") continue;
    ++num_files;
    EXPECT_TRUE(names.contains(entry.path().stem())) << entry.path();
  }
  EXPECT_GT(num_files, 0u);
  EXPECT_EQ(fingerprints.size(), num_files);
}

/** Encodes a message in used memory, none of whose fields is set. */
template <class Message>
std::vector<uint8_t> encode_without_setting_a_field() {
  alignas(Message) std::array<uint8_t, sizeof(Message)> memory;
  memory.fill(0x3f);
  auto* message = new (memory.data()) Message;
  std::vector<uint8_t> bytes(message->getEncodedSize());
  message->encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  std::destroy_at(message);
  return bytes;
}

template <class Message>
class MessageFields : public testing::Test {};
using Messages =
    testing::Types<naolcm::daemon_status_t, naolcm::image_t, naolcm::joint_change_command_t,
                   naolcm::sensor_state_t, naolcm::stop_command_t, naolcm::vision_state_t,
                   naolcm::world_truth_t>;
TYPED_TEST_SUITE(MessageFields, Messages);

TYPED_TEST(MessageFields, SendNothingOfTheMemoryWhenTheyAreNotSet) {
  const auto bytes = encode_without_setting_a_field<TypeParam>();
  EXPECT_EQ(std::count(bytes.begin() + 8, bytes.end(), 0x3f), 0);
}

TEST(MessageTypes, FindsTheTypeOfAMessage) {
  const auto bytes = encoded_stop();
  const MessageType* type = find_message_type(bytes.data(), static_cast<int>(bytes.size()));
  ASSERT_NE(type, nullptr);
  EXPECT_EQ(type->name, "stop_command_t");
  EXPECT_TRUE(type->decodes(bytes.data(), static_cast<int>(bytes.size())));
}

TEST(MessageTypes, RejectsTruncatedAndUnknownMessages) {
  auto bytes = encoded_stop();
  const MessageType* type = find_message_type(bytes.data(), static_cast<int>(bytes.size()));
  ASSERT_NE(type, nullptr);
  for (int size = 8; size < static_cast<int>(bytes.size()); ++size) {
    EXPECT_FALSE(type->decodes(bytes.data(), size)) << size;
  }
  EXPECT_EQ(find_message_type(bytes.data(), 7), nullptr);
  bytes[3] ^= 1;
  EXPECT_EQ(find_message_type(bytes.data(), static_cast<int>(bytes.size())), nullptr);
}

}  // namespace
}  // namespace nao
