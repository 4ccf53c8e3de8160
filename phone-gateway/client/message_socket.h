#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/error.h"
#include "phone-gateway/protocol/framing.h"

namespace nao {

/** The connection to the gateway failed, or was closed. */
struct ConnectionError : Error {
  using Error::Error;
};

/** A TCP connection that carries whole messages, each after its length. One thread only. */
class MessageSocket {
 public:
  /** Connects. @param host  Name or IP address. @param timeout  s.
   * @throws ConnectionError  saying what is wrong with host or port. */
  MessageSocket(const std::string& host, uint16_t port, double timeout);
  ~MessageSocket();
  MessageSocket(const MessageSocket&) = delete;
  MessageSocket& operator=(const MessageSocket&) = delete;

  /** Sends a message whole. @throws ConnectionError  if the other end is gone, or has taken nothing
   * for 5 s. */
  void send(std::string_view message);

  /** Sends bytes as they are, without a length: for tests of what must not be sent. */
  void send_raw(std::string_view bytes);

  /** Waits up to `timeout` seconds for a message. @return nothing if none came in time.
   * @throws ConnectionError  if the other end closed. */
  [[nodiscard]] std::optional<std::string> receive(double timeout);

  int descriptor() const { return descriptor_; }

 private:
  /** The gateway's greatest message is an image, below 64 kB; anything much longer is no gateway.
   */
  static constexpr size_t kMaxMessageBytes = 1 << 20;

  int descriptor_ = -1;
  FrameReader reader_{kMaxMessageBytes};
};

}  // namespace nao
