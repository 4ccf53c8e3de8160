#include "messages/command_publisher.h"

#include <gtest/gtest.h>

#include <map>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/world_command_t.hpp>

#include "messages/light_command.h"
#include "messages/match_command.h"
#include "messages/motion_file.h"
#include "messages/play_command.h"
#include "messages/speech_command.h"

namespace nao {
namespace {

/** Big-endian number of a message, which begins with fingerprint, utime and wall_utime. */
int64_t number_at(const RawMessage& message, size_t offset) {
  uint64_t number = 0;
  for (size_t i = 0; i < 8; ++i) number = number << 8 | message.bytes[offset + i];
  return static_cast<int64_t>(number);
}

TEST(CommandPublisher, GivesEveryCommandTheTimesOfItsSender) {
  Bus bus("memq://");
  const RobotChannels channels("NAO");
  const CommandPublisher commands(bus, channels);
  std::map<std::string, int64_t> utimes;
  bus.subscribe_raw(".*_COMMAND", [&](const RawMessage& message) {
    utimes[message.channel] = number_at(message, 8);
    EXPECT_GT(number_at(message, 16), 0) << message.channel;
  });
  const auto publish_all = [&] {
    utimes.clear();
    for (const decltype(Command::request)& request :
         std::initializer_list<decltype(Command::request)>{WalkCommand{}, MoveToCommand{},
                                                           PostureCommand{}, JointChangeCommand{},
                                                           ActionCommand{}, StopCommand{}}) {
      commands.publish({"test", 1, request});
    }
    commands.publish(channels.light_command, to_message(LightCommand{}), "test", 1);
    commands.publish(channels.speech_command, to_message(SpeechCommand{}), "test", 1);
    commands.publish(channels.play_command, to_message(PlayCommand{}), "test", 1);
    commands.publish(channels.motion_file_command, to_message(MotionFileCommand{}), "test", 1);
    commands.publish(channels.head_camera_command, naolcm::camera_command_t{}, "test");
    commands.publish(kWorldCommandChannel, naolcm::world_command_t{}, "test", 1);
    commands.publish(kMatchCommandChannel, to_message(MatchCommand{}), "test", 1);
    bus.handle();
    EXPECT_EQ(utimes.size(), 13u);
  };
  publish_all();
  for (const auto& [channel, utime] : utimes) EXPECT_EQ(utime, 0) << channel;
  naolcm::motion_state_t state{};
  state.utime = 4'200'000;
  bus.publish(channels.motion_state, state);
  bus.handle();
  publish_all();
  for (const auto& [channel, utime] : utimes) EXPECT_EQ(utime, 4'200'000) << channel;
}

}  // namespace
}  // namespace nao
