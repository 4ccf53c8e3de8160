#include "tools/nao/channel_owners.h"

#include <gmock/gmock.h>

#include "common/bus.h"
#include "naolcm/sensor_state_t.hpp"

namespace nao {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ChannelOwners, FindTwoRobotsOfOneName) {
  ChannelOwners owners;
  for (int i = 0; i < 10; ++i) {
    owners.note("NAO_SENSOR_STATE", 90'000'000 + 10'000 * i);
    owners.note("NAO_SENSOR_STATE", 10'000 * i);
    owners.note("NAO2_SENSOR_STATE", 10'000 * i);
  }
  EXPECT_THAT(owners.find_shared(), ElementsAre("NAO_SENSOR_STATE"));
}

TEST(ChannelOwners, FindTwoProgramsThatAnswerOneRobot) {
  ChannelOwners owners;
  for (int i = 0; i < 20; ++i) owners.note("NAO_JOINT_COMMAND", 10'000 * (i / 2));
  EXPECT_THAT(owners.find_shared(), ElementsAre("NAO_JOINT_COMMAND"));
}

TEST(ChannelOwners, LeaveAResetWorldAndOneThatStandsStillAlone) {
  ChannelOwners owners;
  for (int i = 0; i < 20; ++i) owners.note("NAO_SENSOR_STATE", 10'000 * (i % 15));
  for (int i = 0; i < 20; ++i) owners.note("WORLD_TRUTH", 10'000);
  EXPECT_THAT(owners.find_shared(), IsEmpty());
}

TEST(ChannelOwners, ReadTheTimeOfEncodedMessages) {
  ChannelOwners owners;
  Bus bus("memq://");
  bus.subscribe_raw(kOwnedChannels, [&](const RawMessage& message) {
    owners.note(message.channel, message.bytes.data(), static_cast<int>(message.bytes.size()));
  });
  naolcm::sensor_state_t state{};
  for (int i = 0; i < 6; ++i) {
    state.utime = i % 2 == 0 ? i : 1'000'000'000'000 + i;
    bus.publish("NAO_SENSOR_STATE", state);
    bus.publish("NAO_WALK_COMMAND", state);
  }
  while (bus.handle_for(0)) {
  }
  EXPECT_THAT(owners.find_shared(), ElementsAre("NAO_SENSOR_STATE"));
  EXPECT_FALSE(owners.is_published("NAO_WALK_COMMAND"));
}

}  // namespace
}  // namespace nao
