#include "phone-gateway/server/network/websocket_connection.h"
//
#include <array>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdint>

#include "common/program.h"
#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/network/client_connection.h"

namespace nao::gateway {
namespace {

namespace websocket = beast::websocket;

/** Time for the opening and for the closing handshake, as for Connect. */
constexpr std::chrono::seconds kHandshakeTimeout{5};

using FrameHeader = std::array<uint8_t, 10>;

/** Writes the header of a frame that is a whole binary message of a server (RFC 6455, 5.2).
 * @param size  Of the message, bytes. @return Bytes of the header. */
size_t write_header(size_t size, FrameHeader& header) {
  constexpr uint8_t kFinalBinary = 0x82;
  const int num_size_bytes = size < 126 ? 0 : size <= 0xffff ? 2 : 8;
  const std::array<uint8_t, 2> words{126, 127};
  header[0] = kFinalBinary;
  header[1] = num_size_bytes == 0 ? static_cast<uint8_t>(size) : words[num_size_bytes / 8];
  for (int i = 0; i < num_size_bytes; ++i) {
    header[2 + i] = static_cast<uint8_t>(size >> 8 * (num_size_bytes - 1 - i));
  }
  return 2 + num_size_bytes;
}

/** A client's WebSocket: one message is one binary message. */
class WebSocketConnection : public ClientConnection {
 public:
  WebSocketConnection(ConnectionContext& context, WebStream stream)
      : ClientConnection(context), socket_(std::move(stream)) {}

  void start(WebRequest request) {
    beast::get_lowest_layer(socket_).expires_never();
    // No idle timeout here: the core closes silent connections.
    socket_.set_option(
        websocket::stream_base::timeout{kHandshakeTimeout, websocket::stream_base::none(), false});
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(http::field::server, std::string("nao-phone-gateway/") + version());
    }));
    // Larger messages end the connection with close code 1009 (RFC 6455, 7.4.1).
    socket_.read_message_max(kMaxRequestBytes);
    // One message is one frame; the protocol's messages are small.
    socket_.auto_fragment(false);
    socket_.binary(true);
    request_ = std::move(request);
    socket_.async_accept(request_, [self = self()](const error_code& error) {
      if (error) return;
      self->open(make_endpoint(beast::get_lowest_layer(self->socket_).socket(), "websocket"));
      self->read();
    });
  }

 private:
  std::shared_ptr<WebSocketConnection> self() {
    return std::static_pointer_cast<WebSocketConnection>(shared_from_this());
  }

  void read() {
    socket_.async_read(buffer_, [self = self()](const error_code& error, size_t) {
      if (error) {
        self->note_violation(error);
        self->abort(error == websocket::error::closed ? "closed by the client" : error.message());
        return;
      }
      self->on_message();
    });
  }

  /** Counts a violation of RFC 6455. Beast has sent its close code already. */
  void note_violation(const error_code& error) {
    const bool is_websocket_error =
        error.category() == make_error_code(websocket::error::closed).category();
    if (!is_websocket_error || error == websocket::error::closed) return;
    ++context_.counters.num_violations;
    context_.core.note_refusal(make_endpoint(*socket(), "").address,
                               "WebSocket: " + error.message());
  }

  void on_message() {
    // RFC 6455, 7.4.1: code 1003 for a type of data that is not accepted.
    if (!socket_.got_binary()) {
      close_code_ = websocket::close_code::unknown_data;
      reject(gateway_reason("text-message"));
    }
    bool may_read = true;
    if (!is_closing()) {
      may_read = receive({static_cast<const char*>(buffer_.data().data()), buffer_.size()});
    }
    buffer_.consume(buffer_.size());
    if (may_read) read();
  }

  void resume_reading() override { read(); }

  bool write(MessageBytes message) override {
    outgoing_ = std::move(message);
    const auto on_sent = [self = self()](const error_code& error, size_t) {
      self->on_written(error.failed());
    };
    // Beast takes about as long for a frame as the system call that sends it.
    if (socket_.is_open()) {
      const size_t size = write_header(outgoing_->size(), header_);
      const auto written = socket_.next_layer().write_now(
          std::array<asio::const_buffer, 2>{asio::buffer(header_, size), asio::buffer(*outgoing_)},
          on_sent);
      if (written != WebStream::Written::kNothing) return written == WebStream::Written::kAll;
    }
    socket_.async_write(asio::buffer(*outgoing_), on_sent);
    return false;
  }

  void shut_down() override {
    // The closing handshake; its end, or its timeout, ends the connection.
    socket_.async_close(websocket::close_reason(close_code_), [self = self()](const error_code&) {
      self->abort("closed by the gateway");
    });
  }

  Tcp::socket* socket() override { return &beast::get_lowest_layer(socket_).socket(); }

  void close_socket() override { beast::get_lowest_layer(socket_).close(); }

  websocket::stream<WebStream> socket_;
  WebRequest request_;
  beast::flat_buffer buffer_;
  MessageBytes outgoing_;
  FrameHeader header_{};
  websocket::close_code close_code_ = websocket::close_code::policy_error;
};

}  // namespace

void serve_websocket(ConnectionContext& context, WebStream stream, WebRequest request) {
  std::make_shared<WebSocketConnection>(context, std::move(stream))->start(std::move(request));
}

}  // namespace nao::gateway
