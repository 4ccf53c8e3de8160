#pragma once

#include <cstdint>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/wall_clock.h"
#include "messages/command.h"

namespace nao {

/** Publishes commands, each as the message of its channel, with the sender's times. */
class CommandPublisher {
 public:
  /** Receives the robot's NAO_MOTION_STATE for its time. @param bus  Must outlive this; this must
   * outlive the bus's last handle(). */
  CommandPublisher(Bus& bus, const RobotChannels& channels);
  CommandPublisher(const CommandPublisher&) = delete;
  CommandPublisher& operator=(const CommandPublisher&) = delete;

  /** A command of nao-motion. */
  void publish(const Command& command) const;

  /** Any command's message.
   * @param id  Number of the command; unused by image requests, which have none. */
  template <class Message>
  void publish(const std::string& channel, Message message, const std::string& source,
               int64_t id = 0) const {
    message.utime = robot_utime_;
    message.wall_utime = wall_utime();
    message.source = source;
    if constexpr (requires { message.command_id; }) message.command_id = id;
    bus_.publish(channel, message);
  }

  /** Receives one motion state, and no more until the next call of either function: for programs
   * that seldom send. */
  void nap() { listen(true); }
  /** Ends nap(). */
  void wake() { listen(false); }

  /** `utime` of the commands: robot time, microseconds; 0 as long as there was no motion state. */
  int64_t robot_utime() const { return robot_utime_; }

 private:
  void listen(bool once) {
    if (!once && !is_napping_) return;
    is_napping_ = once;
    bus_.set_awake(channels_.motion_state, true);
  }

  Bus& bus_;
  RobotChannels channels_;
  int64_t robot_utime_ = 0;
  bool is_napping_ = false;
};

}  // namespace nao
