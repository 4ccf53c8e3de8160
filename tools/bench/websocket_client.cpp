#include "tools/bench/websocket_client.h"

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <stdexcept>

namespace nao::bench {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;

/** One asynchronous read is always in progress; read() runs the handlers that are ready. */
struct WebSocketClient::Impl {
  explicit Impl(const Options& options) {
    error_code error;
    socket.next_layer().connect({asio::ip::make_address_v4(options.host), options.port}, error);
    if (error) {
      throw std::runtime_error("no server on port " + std::to_string(options.port) + ": " +
                               error.message());
    }
    socket.next_layer().set_option(asio::ip::tcp::no_delay(true));
    if (!options.subprotocol.empty()) {
      socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
        request.set(beast::http::field::sec_websocket_protocol, options.subprotocol);
      }));
    }
    socket.handshake(options.host, options.target);
    socket.read_message_max(options.max_message_bytes);
    start_reading();
  }

  void start_reading() {
    socket.async_read(buffer, [this](const error_code& error, size_t) {
      if (error) {
        read_error = error;
        return;
      }
      messages.push_back({socket.got_text(), beast::buffers_to_string(buffer.data())});
      buffer.consume(buffer.size());
      start_reading();
    });
  }

  void send(std::string_view message, bool is_text) {
    socket.text(is_text);
    socket.write(asio::buffer(message));
  }

  asio::io_context io{1};
  websocket::stream<asio::ip::tcp::socket> socket{io};
  beast::flat_buffer buffer;
  std::vector<Message> messages;
  std::optional<error_code> read_error;
};

WebSocketClient::WebSocketClient(const Options& options) : impl_(std::make_unique<Impl>(options)) {}

WebSocketClient::~WebSocketClient() = default;

void WebSocketClient::send_text(std::string_view text) {
  impl_->send(text, true);
}

void WebSocketClient::send_binary(std::string_view bytes) {
  impl_->send(bytes, false);
}

void WebSocketClient::read() {
  impl_->io.restart();
  impl_->io.poll();
  if (impl_->read_error) {
    throw std::runtime_error("the server closed the connection: " + impl_->read_error->message());
  }
}

std::vector<WebSocketClient::Message> WebSocketClient::take_messages() {
  return std::exchange(impl_->messages, {});
}

int WebSocketClient::descriptor() const {
  return impl_->socket.next_layer().native_handle();
}

}  // namespace nao::bench
