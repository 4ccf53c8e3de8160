#include "tools/bench/wire_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <cerrno>
#include <optional>
#include <stdexcept>

#include "phone-gateway/protocol/framing.h"

namespace nao {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;

/** Above every message of the gateway, which are below 100 kB. */
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

/** A client over a WebSocket. One asynchronous read is always in progress; read() runs the handlers
 * that are ready. */
class WebSocketClient : public WireClient {
 public:
  explicit WebSocketClient(uint16_t port) : websocket_(io_) {
    const asio::ip::tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
    boost::system::error_code error;
    websocket_.next_layer().connect(endpoint, error);
    if (error) throw std::runtime_error("no gateway on port " + std::to_string(port));
    websocket_.next_layer().set_option(asio::ip::tcp::no_delay(true));
    websocket_.handshake("localhost", "/ws");
    websocket_.binary(true);
    websocket_.read_message_max(kMaxMessageBytes);
    descriptor_ = websocket_.next_layer().native_handle();
    start_reading();
  }

  void send(const naoremote::Request& request) override {
    websocket_.write(asio::buffer(request.SerializeAsString()));
  }

  void read() override {
    io_.restart();
    io_.poll();
    if (error_) {
      throw std::runtime_error("the gateway closed the connection: " + error_->message());
    }
  }

  int descriptor() const override { return descriptor_; }

 private:
  void start_reading() {
    websocket_.async_read(buffer_, [this](const boost::system::error_code& error, size_t) {
      if (error) {
        error_ = error;
        return;
      }
      messages_.push_back(beast::buffers_to_string(buffer_.data()));
      buffer_.consume(buffer_.size());
      start_reading();
    });
  }

  asio::io_context io_{1};
  beast::websocket::stream<asio::ip::tcp::socket> websocket_;
  int descriptor_ = -1;
  beast::flat_buffer buffer_;
  std::optional<boost::system::error_code> error_;
};

}  // namespace

int connect_to_own_host(uint16_t port) {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    close(descriptor);
    throw std::runtime_error("nothing listens on port " + std::to_string(port));
  }
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return descriptor;
}

std::vector<naoremote::ServerMessage> WireClient::take_messages() {
  std::vector<naoremote::ServerMessage> decoded(messages_.size());
  for (size_t i = 0; i < messages_.size(); ++i) {
    if (!decoded[i].ParseFromString(messages_[i])) {
      throw std::runtime_error("the gateway sent a message that is no ServerMessage");
    }
  }
  messages_.clear();
  return decoded;
}

std::unique_ptr<WireClient> connect_tcp(uint16_t port) {
  return std::make_unique<TcpClient>(port);
}

std::unique_ptr<WireClient> connect_websocket(uint16_t port) {
  return std::make_unique<WebSocketClient>(port);
}

}  // namespace nao
