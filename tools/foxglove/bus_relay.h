#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "inspection/foxglove_converter.h"
#include "message_reflection/message_layout.h"
#include "tools/foxglove/server_core.h"

namespace nao::foxglove {

/** Passes the messages of the bus to the server's channels: every channel of the bus under its own
 * name, from its first message on, and the outputs of the converter. A message is encoded once for
 * all clients, and only while a client subscribes to it. */
class BusRelay {
 public:
  /** Both must outlive this. Adds the converter's outputs to the channels. */
  BusRelay(ServerCore& core, FoxgloveConverter& converter);
  BusRelay(const BusRelay&) = delete;
  BusRelay& operator=(const BusRelay&) = delete;

  /** @param wall_utime  Time of reception, microseconds since 1970. */
  void receive(const std::string& channel, std::span<const uint8_t> message, int64_t wall_utime);

  /** Cameras whose images a client subscribes to. */
  std::set<std::string> wanted_cameras() const;

  /** Messages of unknown types, or damaged ones. */
  int64_t num_undecodable() const { return num_undecodable_; }

 private:
  struct BusChannel {
    const MessageLayout* layout = nullptr;
    uint32_t number = 0;
    /** Last message, for clients that subscribe later. */
    std::vector<uint8_t> message;
    int64_t wall_utime = 0;
  };

  void send_last(uint32_t client, uint32_t number);

  ServerCore& core_;
  FoxgloveConverter& converter_;
  /** Numbers of the converter's outputs. */
  std::vector<uint32_t> outputs_;
  std::map<std::string, BusChannel> channels_;
  int64_t num_undecodable_ = 0;
};

}  // namespace nao::foxglove
