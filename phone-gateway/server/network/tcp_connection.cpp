#include "phone-gateway/server/network/client_connection.h"
//
#include <algorithm>
#include <array>
#include <boost/asio/write.hpp>
#include <optional>

#include "phone-gateway/protocol/framing.h"

namespace nao::gateway {
namespace {

using boost::system::error_code;

/** A connection of the raw TCP port. */
class TcpConnection : public ClientConnection {
 public:
  TcpConnection(ConnectionContext& context, Tcp::socket socket)
      : ClientConnection(context), socket_(std::move(socket)) {}

  void start() {
    open(make_endpoint(socket_, "tcp"));
    read();
  }

 private:
  std::shared_ptr<TcpConnection> self() {
    return std::static_pointer_cast<TcpConnection>(shared_from_this());
  }

  void read() {
    socket_.async_read_some(asio::buffer(bytes_),
                            [self = self()](const error_code& error, size_t size) {
                              if (error) {
                                self->abort("closed by the client");
                                return;
                              }
                              if (!self->is_closing()) {
                                self->reader_.add({self->bytes_.data(), size});
                              }
                              self->resume_reading();
                            });
  }

  void resume_reading() override {
    // A received block may hold several messages. receive() says no when the client is to be
    // paused; it calls this function again then.
    while (!is_closing()) {
      const std::optional<std::string> message = reader_.next();
      if (!message) break;
      if (!receive(*message)) return;
    }
    if (reader_.is_oversized() && !is_closing()) {
      reject(gateway_reason("message-too-long", {std::to_string(kMaxRequestBytes)}));
    }
    // Also while closing, to notice when the other end closes.
    read();
  }

  bool write(MessageBytes message) override {
    outgoing_ = std::move(message);
    length_ = frame_length(outgoing_->size());
    // Length and message in one call, without copying both into one buffer.
    using Buffers = std::array<asio::const_buffer, 2>;
    const size_t sent = send_now(socket_, Buffers{asio::buffer(length_), asio::buffer(*outgoing_)});
    if (sent == length_.size() + outgoing_->size()) return true;
    const size_t of_length = std::min(sent, length_.size());
    asio::async_write(
        socket_,
        Buffers{asio::buffer(length_) + of_length, asio::buffer(*outgoing_) + (sent - of_length)},
        [self = self()](const error_code& error, size_t) { self->on_written(error.failed()); });
    return false;
  }

  void shut_down() override {
    error_code ignored;
    socket_.shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Tcp::socket* socket() override { return &socket_; }

  void close_socket() override {
    error_code ignored;
    socket_.close(ignored);
  }

  Tcp::socket socket_;
  FrameReader reader_{kMaxRequestBytes};
  /** Chosen: far above usual requests (below 100 bytes), small enough for 128 half-open
   * connections. */
  std::array<char, 16384> bytes_;
  MessageBytes outgoing_;
  std::array<char, kFrameLengthBytes> length_{};
};

}  // namespace

void serve_tcp(ConnectionContext& context, Tcp::socket socket) {
  std::make_shared<TcpConnection>(context, std::move(socket))->start();
}

}  // namespace nao::gateway
