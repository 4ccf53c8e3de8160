#include "tools/bench/wire_client.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <utility>

#include "phone-gateway/protocol/framing.h"
#include "tools/bench/ports.h"
#include "tools/bench/websocket_client.h"

namespace nao::bench {
namespace {

/** Greatest size of a message, bytes: the gateway's are below 100 kB. */
constexpr size_t kMaxMessageBytes = 1 << 20;

/** A client over raw TCP. */
class TcpClient : public WireClient {
 public:
  explicit TcpClient(uint16_t port) : descriptor_(connect_to_own_host(port)) {}
  ~TcpClient() override { close(descriptor_); }
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;

  void send(const naoremote::Request& request) override {
    const std::string bytes = frame(request.SerializeAsString());
    if (::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the connection is lost");
    }
  }

  void read() override {
    std::array<char, 65536> bytes;
    const ssize_t size = recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size == 0 || (size < 0 && errno != EAGAIN)) {
      throw std::runtime_error("the gateway closed the connection");
    }
    if (size < 0) return;
    reader_.add({bytes.data(), static_cast<size_t>(size)});
    while (auto message = reader_.next()) messages_.push_back(std::move(*message));
  }

  int descriptor() const override { return descriptor_; }

 private:
  int descriptor_;
  FrameReader reader_{kMaxMessageBytes};
};

/** A client over a WebSocket: one message is one binary message. */
class WebSocketWireClient : public WireClient {
 public:
  WebSocketWireClient(uint16_t port, const std::string& host)
      : socket_(
            {.host = host, .port = port, .target = "/ws", .max_message_bytes = kMaxMessageBytes}) {}

  void send(const naoremote::Request& request) override {
    socket_.send_binary(request.SerializeAsString());
  }

  void read() override {
    socket_.read();
    for (auto& message : socket_.take_messages()) messages_.push_back(std::move(message.bytes));
  }

  int descriptor() const override { return socket_.descriptor(); }

 private:
  WebSocketClient socket_;
};

}  // namespace

std::vector<naoremote::ServerMessage> WireClient::take_messages() {
  std::vector<naoremote::ServerMessage> decoded(messages_.size());
  for (size_t i = 0; i < messages_.size(); ++i) {
    if (!decoded[i].ParseFromString(messages_[i])) {
      throw std::runtime_error("the gateway sent a message that is not a ServerMessage");
    }
  }
  messages_.clear();
  return decoded;
}

std::unique_ptr<WireClient> connect_tcp(uint16_t port) {
  return std::make_unique<TcpClient>(port);
}

std::unique_ptr<WireClient> connect_websocket(uint16_t port, const std::string& host) {
  return std::make_unique<WebSocketWireClient>(port, host);
}

}  // namespace nao::bench
