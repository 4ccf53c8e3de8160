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

/** A TCP connection for whole messages, each after its length. Not thread-safe. */
class MessageSocket {
 public:
  /** @param host     Name or IP address.
   * @param timeout  For connecting, s.
   * @throws ConnectionError  naming the host or port that cannot be reached. */
  MessageSocket(const std::string& host, uint16_t port, double timeout);
  ~MessageSocket();
  MessageSocket(const MessageSocket&) = delete;
  MessageSocket& operator=(const MessageSocket&) = delete;

  /** Sends a message. @throws ConnectionError  if the connection is lost, or the gateway has not
   * read for 5 s. */
  void send(std::string_view message);

  /** Sends bytes without a length, for tests with invalid input. */
  void send_raw(std::string_view bytes);

  /** Waits up to `timeout` s for a message. @return Nothing if none was received in time.
   * @throws ConnectionError  if the gateway closed the connection. */
  [[nodiscard]] std::optional<std::string> receive(double timeout);

  int descriptor() const { return descriptor_; }

 private:
  /** Above every message of the gateway, which are below 100 kB. */
  static constexpr size_t kMaxMessageBytes = 1 << 20;

  int descriptor_ = -1;
  FrameReader reader_{kMaxMessageBytes};
};

}  // namespace nao
