#include "phone-gateway/server/phone_connection.h"
//
#include <array>
#include <boost/asio/write.hpp>
#include <optional>

#include "phone-gateway/protocol/framing.h"

namespace nao {
namespace {

using boost::system::error_code;

/** A connection of the raw TCP port. */
class TcpConnection : public PhoneConnection {
 public:
  TcpConnection(Hub& hub, Tcp::socket socket) : PhoneConnection(hub), socket_(std::move(socket)) {}

  void start() {
    open(make_peer(socket_, "tcp"));
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
                              self->take_more();
                            });
  }

  void take_more() override {
    while (!is_closing()) {
      const std::optional<std::string> message = reader_.next();
      if (!message) break;
      if (!receive(*message)) return;
    }
    if (reader_.is_oversized() && !is_closing()) {
      violate("A message must not be longer than 65536 bytes.");
    }
    // Also while closing, to see the other end close.
    read();
  }

  void write(MessageBytes message) override {
    outgoing_ = std::move(message);
    length_ = frame_length(outgoing_->size());
    asio::async_write(
        socket_, std::array<asio::const_buffer, 2>{asio::buffer(length_), asio::buffer(*outgoing_)},
        [self = self()](const error_code& error, size_t) { self->on_written(error.failed()); });
  }

  void shut_down() override {
    error_code ignored;
    socket_.shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Tcp::socket& socket() override { return socket_; }

  void close_socket() override {
    error_code ignored;
    socket_.close(ignored);
  }

  Tcp::socket socket_;
  FrameReader reader_{kMaxRequestBytes};
  std::array<char, 16384> bytes_;
  MessageBytes outgoing_;
  std::array<char, kFrameLengthBytes> length_{};
};

}  // namespace

void serve_tcp(Hub& hub, Tcp::socket socket) {
  std::make_shared<TcpConnection>(hub, std::move(socket))->start();
}

}  // namespace nao
