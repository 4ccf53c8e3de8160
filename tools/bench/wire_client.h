#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "remote.pb.h"

namespace nao {

/** A phone reduced to its socket, so that what is measured is the gateway. */
class WireClient {
 public:
  virtual ~WireClient() = default;

  /** Sends a request. @throws std::runtime_error  if the connection is gone. */
  virtual void send(const naoremote::Request& request) = 0;

  /** Reads what has come, without waiting. @throws std::runtime_error  if the connection is gone.
   */
  void read();
  /** The messages in what was read. @throws std::runtime_error  if one is none. */
  std::vector<naoremote::ServerMessage> take_messages();

  int descriptor() const { return descriptor_; }

 protected:
  /** Takes the next whole message off the front of `bytes_`. @return false if there is none. */
  virtual bool take_message(std::string& message) = 0;
  void connect(uint16_t port);
  void send_bytes(const std::string& bytes);
  /** Waits until bytes have come, and appends them. */
  void wait_for_bytes();

  int descriptor_ = -1;
  std::string bytes_;
};

/** Connections to a gateway on this host, which have not said Connect. */
std::unique_ptr<WireClient> connect_tcp(uint16_t port);
std::unique_ptr<WireClient> connect_websocket(uint16_t port);

}  // namespace nao
