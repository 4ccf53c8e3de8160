#include "tools/bench/wire_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>

#include "phone-gateway/protocol/framing.h"

namespace nao {
namespace {

constexpr size_t kMaxMessageBytes = 1 << 20;

class TcpClient : public WireClient {
 public:
  explicit TcpClient(uint16_t port) { connect(port); }
  ~TcpClient() override { close(descriptor_); }

  void send(const naoremote::Request& request) override {
    send_bytes(frame(request.SerializeAsString()));
  }

 private:
  bool take_message(std::string& message) override {
    reader_.add(bytes_);
    bytes_.clear();
    auto next = reader_.next();
    if (!next) return false;
    message = std::move(*next);
    return true;
  }

  FrameReader reader_{kMaxMessageBytes};
};

/** RFC 6455, as much of it as the gateway uses: binary messages in one frame. */
class WebSocketClient : public WireClient {
 public:
  explicit WebSocketClient(uint16_t port) {
    connect(port);
    send_bytes(
        "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
    size_t end = std::string::npos;
    while ((end = bytes_.find("\r\n\r\n")) == std::string::npos) wait_for_bytes();
    if (bytes_.find(" 101 ") == std::string::npos) throw std::runtime_error(bytes_);
    bytes_.erase(0, end + 4);
  }
  ~WebSocketClient() override { close(descriptor_); }

  void send(const naoremote::Request& request) override {
    const std::string message = request.SerializeAsString();
    std::string bytes = "\x82";
    if (message.size() < 126) {
      bytes.push_back(static_cast<char>(0x80 | message.size()));
    } else {
      bytes.push_back(static_cast<char>(0x80 | 126));
      bytes.push_back(static_cast<char>(message.size() >> 8));
      bytes.push_back(static_cast<char>(message.size() & 0xff));
    }
    // A mask of zero leaves the payload as it is, and is as good as any to the other end.
    bytes.append(4, '\0');
    send_bytes(bytes + message);
  }

 private:
  bool take_message(std::string& message) override {
    const auto byte = [this](size_t i) { return static_cast<unsigned char>(bytes_[i]); };
    if (bytes_.size() < 2) return false;
    size_t length = byte(1) & 0x7f;
    size_t start = 2;
    if (length >= 126) {
      const size_t num_bytes = length == 126 ? 2 : 8;
      start += num_bytes;
      if (bytes_.size() < start) return false;
      length = 0;
      for (size_t i = 2; i < start; ++i) length = length << 8 | byte(i);
    }
    if (bytes_.size() < start + length) return false;
    if (byte(0) != 0x82) throw std::runtime_error("the gateway closes the WebSocket");
    message = bytes_.substr(start, length);
    bytes_.erase(0, start + length);
    return true;
  }
};

}  // namespace

void WireClient::connect(uint16_t port) {
  descriptor_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("no gateway on port " + std::to_string(port));
  }
  const int on = 1;
  setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

void WireClient::send_bytes(const std::string& bytes) {
  if (::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the connection is lost");
  }
}

void WireClient::wait_for_bytes() {
  std::array<char, 65536> part;
  const ssize_t size = recv(descriptor_, part.data(), part.size(), 0);
  if (size <= 0) throw std::runtime_error("the gateway closed the connection");
  bytes_.append(part.data(), static_cast<size_t>(size));
}

void WireClient::read() {
  std::array<char, 65536> part;
  const ssize_t size = recv(descriptor_, part.data(), part.size(), MSG_DONTWAIT);
  if (size == 0 || (size < 0 && errno != EAGAIN)) {
    throw std::runtime_error("the gateway closed the connection");
  }
  if (size > 0) bytes_.append(part.data(), static_cast<size_t>(size));
}

std::vector<naoremote::ServerMessage> WireClient::take_messages() {
  std::vector<naoremote::ServerMessage> messages;
  for (std::string bytes; take_message(bytes);) {
    messages.emplace_back();
    if (!messages.back().ParseFromString(bytes)) throw std::runtime_error("no ServerMessage");
  }
  return messages;
}

std::unique_ptr<WireClient> connect_tcp(uint16_t port) {
  return std::make_unique<TcpClient>(port);
}

std::unique_ptr<WireClient> connect_websocket(uint16_t port) {
  return std::make_unique<WebSocketClient>(port);
}

}  // namespace nao
