#pragma once

#include <cstdint>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/wall_clock.h"
#include "messages/command.h"

namespace nao {

/** Publishes commands, each as the message of its channel. */
class CommandPublisher {
 public:
  /** Both must outlive this. */
  CommandPublisher(Bus& bus, const RobotChannels& channels) : bus_(bus), channels_(channels) {}

  /** A command of nao-motion. */
  void publish(const Command& command) const;

  /** Any command's message, with its sender and number. */
  template <class Message>
  void publish(const std::string& channel, Message& message, const std::string& source,
               int64_t id) const {
    message.utime = 0;
    message.wall_utime = wall_utime();
    message.source = source;
    message.command_id = id;
    bus_.publish(channel, message);
  }

 private:
  Bus& bus_;
  const RobotChannels& channels_;
};

}  // namespace nao
