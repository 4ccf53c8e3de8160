#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "remote.pb.h"

namespace nao::bench {

/** A client of the gateway that does as little as possible, so that a benchmark measures the
 * gateway.
 *
 * Reading and decoding are separate: a benchmark first reads from all readable clients and notes
 * the time, then decodes. */
class WireClient {
 public:
  virtual ~WireClient() = default;

  /** Sends a request. @throws std::runtime_error  if the connection is lost. */
  virtual void send(const naoremote::Request& request) = 0;

  /** Reads what has been received, without waiting.
   * @throws std::runtime_error  if the connection is lost. */
  virtual void read() = 0;

  /** The whole messages that were read. @throws std::runtime_error  if one is not a ServerMessage.
   */
  std::vector<naoremote::ServerMessage> take_messages();

  /** Readable when read() has something to read. */
  virtual int descriptor() const = 0;

 protected:
  /** Messages that were read, not decoded. */
  std::vector<std::string> messages_;
};

/** Connections to a gateway, without Connect. @param host  IPv4 address.
 * @throws std::runtime_error  if there is no gateway. */
std::unique_ptr<WireClient> connect_tcp(uint16_t port);
std::unique_ptr<WireClient> connect_websocket(uint16_t port, const std::string& host = "127.0.0.1");

}  // namespace nao::bench
