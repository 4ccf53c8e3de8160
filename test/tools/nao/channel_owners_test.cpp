#include "tools/nao/channel_owners.h"

#include <gmock/gmock.h>

#include <naolcm/daemon_status_t.hpp>

namespace nao {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<uint8_t> datagram(const std::string& channel,
                              const std::vector<uint8_t>& message = {}) {
  std::vector<uint8_t> bytes{'L', 'C', '0', '2', 0, 0, 0, 1};
  bytes.insert(bytes.end(), channel.c_str(), channel.c_str() + channel.size() + 1);
  bytes.insert(bytes.end(), message.begin(), message.end());
  return bytes;
}

void name(ChannelOwners& owners, const std::string& sender, const std::string& program) {
  naolcm::daemon_status_t status;
  status.program = program;
  status.host = "pc";
  status.process_id = 12;
  std::vector<uint8_t> message(static_cast<size_t>(status.getEncodedSize()));
  status.encode(message.data(), 0, static_cast<int>(message.size()));
  owners.note(sender, datagram("DAEMON_STATUS", message));
}

TEST(ChannelOwners, NameTwoThatPublishInTurns) {
  ChannelOwners owners;
  for (int i = 0; i < 3; ++i) {
    owners.note("10.0.0.1:4000", datagram("NAO_SENSOR_STATE"));
    owners.note("10.0.0.2:4000", datagram("NAO_SENSOR_STATE"));
    owners.note("10.0.0.1:4000", datagram("NAO2_SENSOR_STATE"));
  }
  name(owners, "10.0.0.1:4000", "nao-sim");
  EXPECT_THAT(owners.find_shared(), ElementsAre("NAO_SENSOR_STATE"));
  EXPECT_THAT(owners.owners_of("NAO_SENSOR_STATE"),
              ElementsAre("nao-sim of host pc (process 12)", "10.0.0.2:4000"));
  EXPECT_THAT(owners.owners_of("NAO2_SENSOR_STATE"),
              ElementsAre("nao-sim of host pc (process 12)"));
  EXPECT_THAT(owners.owners_of("NAO3_SENSOR_STATE"), IsEmpty());
}

TEST(ChannelOwners, LeaveARestartAndChannelsOfManyAlone) {
  ChannelOwners owners;
  for (int i = 0; i < 20; ++i) {
    owners.note(i < 10 ? "127.0.0.1:4000" : "127.0.0.1:4001", datagram("NAO_SENSOR_STATE"));
    owners.note("127.0.0.1:" + std::to_string(5000 + i % 2), datagram("NAO_WALK_COMMAND"));
  }
  EXPECT_THAT(owners.find_shared(), IsEmpty());
}

TEST(ChannelOwners, SkipWhatIsNoMessage) {
  ChannelOwners owners;
  const std::vector<uint8_t> whole = datagram("NAO_SENSOR_STATE");
  for (size_t size = 0; size < whole.size(); ++size) {
    owners.note("10.0.0.1:4000", std::span(whole).first(size));
  }
  owners.note("10.0.0.1:4000", datagram("DAEMON_STATUS", {1, 2, 3}));
  EXPECT_THAT(owners.owners_of("NAO_SENSOR_STATE"), IsEmpty());
}

}  // namespace
}  // namespace nao
