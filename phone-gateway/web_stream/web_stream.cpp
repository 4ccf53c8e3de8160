#include "phone-gateway/web_stream/web_stream.h"
//
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace nao {

namespace asio = boost::asio;
namespace beast = boost::beast;

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
  } else {
    plain_->async_write_some(buffers, std::move(completion));
  }
}

void WebStream::tear_down(beast::role_type role, Completion completion) {
  if (secure_) {
    secure_->stream.async_shutdown(std::move(completion));
  } else {
    beast::async_teardown(role, *plain_, std::move(completion));
  }
}

}  // namespace nao
