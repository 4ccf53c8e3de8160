#include "phone-gateway/web_stream/web_stream.h"
//
#include <boost/asio/write.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <memory>
#include <utility>

namespace nao {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;

struct WebStream::Secure {
  beast::ssl_stream<beast::tcp_stream> stream;
};

WebStream::WebStream(beast::tcp_stream stream)
    : plain_(std::make_unique<beast::tcp_stream>(std::move(stream))) {}

WebStream::WebStream(beast::tcp_stream stream, asio::ssl::context& tls)
    : secure_(new Secure{beast::ssl_stream<beast::tcp_stream>(std::move(stream), tls)}) {}

WebStream::~WebStream() = default;
WebStream::WebStream(WebStream&&) noexcept = default;
WebStream& WebStream::operator=(WebStream&&) noexcept = default;

WebStream::next_layer_type& WebStream::next_layer() {
  return secure_ ? secure_->stream.next_layer() : *plain_;
}

const WebStream::next_layer_type& WebStream::next_layer() const {
  return secure_ ? secure_->stream.next_layer() : *plain_;
}

void WebStream::handshake(asio::const_buffer received, Completion completion) {
  secure_->stream.async_handshake(asio::ssl::stream_base::server, received, std::move(completion));
}

void WebStream::connect(const std::string& host, Completion completion) {
  SSL_set_tlsext_host_name(secure_->stream.native_handle(), host.c_str());
  secure_->stream.async_handshake(asio::ssl::stream_base::client, std::move(completion));
}

void WebStream::read_some(const BufferList<asio::mutable_buffer>& buffers, Completion completion) {
  if (secure_) {
    secure_->stream.async_read_some(buffers, std::move(completion));
  } else {
    plain_->async_read_some(buffers, std::move(completion));
  }
}

void WebStream::write_some(const BufferList<asio::const_buffer>& buffers, Completion completion) {
  if (secure_) {
    secure_->stream.async_write_some(buffers, std::move(completion));
    return;
  }
  const auto shared = std::make_shared<Completion>(std::move(completion));
  const auto write = [this, buffers, shared] {
    plain_->async_write_some(buffers, [this, shared](const error_code& error, size_t size) {
      // A frame that is not finished goes on within the call.
      is_writing_ = false;
      (*shared)(error, size);
    });
  };
  is_writing_ = true;
  if (is_writing_rest_) {
    waiting_write_ = write;
  } else {
    write();
  }
}

size_t WebStream::write_at_once(const BufferList<asio::const_buffer>& buffers) {
  if (secure_ || is_writing_ || is_writing_rest_) return 0;
  error_code error;
  const size_t size = plain_->socket().send(buffers, 0, error);
  return error ? 0 : size;
}

void WebStream::write_rest(const BufferList<asio::const_buffer>& rest, Completion completion) {
  is_writing_rest_ = true;
  const auto shared = std::make_shared<Completion>(std::move(completion));
  asio::async_write(plain_->socket(), rest, [this, shared](const error_code& error, size_t size) {
    is_writing_rest_ = false;
    if (const auto write = std::exchange(waiting_write_, nullptr)) write();
    (*shared)(error, size);
  });
}

void WebStream::tear_down(beast::role_type role, Completion completion) {
  if (secure_) {
    secure_->stream.async_shutdown(std::move(completion));
  } else {
    beast::async_teardown(role, *plain_, std::move(completion));
  }
}

}  // namespace nao
