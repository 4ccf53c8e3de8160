#pragma once

#include "common/bus.h"
#include "common/channels.h"
#include "messages/command.h"

namespace nao::gateway {

/** Publishes commands, each as the message of its channel. */
class CommandPublisher {
 public:
  /** Both must outlive this. */
  CommandPublisher(Bus& bus, const RobotChannels& channels) : bus_(bus), channels_(channels) {}

  void publish(const Command& command) const;

 private:
  Bus& bus_;
  const RobotChannels& channels_;
};

}  // namespace nao::gateway
