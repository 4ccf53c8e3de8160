#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace nao::bench {

/** A WebSocket to a server that does as little as possible, so that a benchmark
 * measures the server. */
class WebSocketClient {
 public:
  struct Options {
    /** IPv4 address. */
    std::string host = "127.0.0.1";
    uint16_t port = 0;
    std::string target = "/";
    /** Subprotocol that is offered; empty: none. */
    std::string subprotocol = "";
    /** Larger messages end the connection. */
    size_t max_message_bytes = 1 << 20;
  };
  struct Message {
    bool is_text = false;
    std::string bytes;
  };

  /** @throws std::runtime_error  if there is no such server. */
  explicit WebSocketClient(const Options& options);
  ~WebSocketClient();

  /** Both throw std::runtime_error if the connection is lost. */
  void send_text(std::string_view text);
  void send_binary(std::string_view bytes);

  /** Reads what has been received, without waiting.
   * @throws std::runtime_error  if the connection is lost. */
  void read();

  /** The whole messages that were read. */
  std::vector<Message> take_messages();

  /** Readable when read() has something to read. */
  int descriptor() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao::bench
