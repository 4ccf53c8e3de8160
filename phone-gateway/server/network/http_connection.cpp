#include "phone-gateway/server/network/http_server.h"
//
#include <boost/beast/core/detect_ssl.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <optional>

#include "common/program.h"

namespace nao::gateway {
namespace {

/** Time for the TLS handshake and the first request, as for Connect, and for the next request.
 * Chosen: a browser fetches a page's files within a second, and opens a new connection later. */
constexpr std::chrono::seconds kRequestTimeout{5};
constexpr std::chrono::seconds kKeepAliveTimeout{15};
/** Time in which one response must be sent. Chosen: 1 MB at 34 kB/s. */
constexpr std::chrono::seconds kResponseTimeout{30};
/** As common web servers allow (nginx: 4 buffers of 8 kB, Apache: 8 kB a line). */
constexpr uint32_t kMaxHeaderBytes = 8192;
constexpr int kHttpVersion = 11;
constexpr const char* kNoRequest = "No request within 5 s.";

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

/** An entry of the handshake limiter, for as long as this lives. */
class HandshakeGuard {
 public:
  HandshakeGuard(HttpContext& context, const std::string& address, std::function<void()> evict)
      : context_(context) {
    if (context_.handshakes.add(address, std::move(evict), entry_)) {
      note_eviction(context_, address);
    }
  }
  ~HandshakeGuard() { context_.handshakes.remove(entry_); }
  HandshakeGuard(const HandshakeGuard&) = delete;
  HandshakeGuard& operator=(const HandshakeGuard&) = delete;

 private:
  HttpContext& context_;
  HandshakeLimiter::Entry entry_;
};

/** An HTTP connection: answers one request after the other, until one asks for a WebSocket. */
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(HttpContext& context, WebStream stream, beast::flat_buffer buffer)
      : context_(context), stream_(std::move(stream)), buffer_(std::move(buffer)) {}

  // The first request, or TLS handshake, must come within kRequestTimeout: connections that send
  // nothing are not kept.
  void start() {
    endpoint_ = make_endpoint(stream_.next_layer().socket(), "websocket");
    const auto weak = weak_from_this();
    handshake_.emplace(context_, endpoint_.address, [weak] {
      // Operations in progress end with an error, which ends the connection.
      if (const auto self = weak.lock()) self->stream_.next_layer().cancel();
    });
    if (!stream_.is_secure()) {
      read(kRequestTimeout);
      return;
    }
    stream_.next_layer().expires_after(kRequestTimeout);
    stream_.handshake(buffer_.data(),
                      Completion(
                          [self = shared_from_this()](const error_code& error, size_t n) {
                            if (error) {
                              self->note_refusal("TLS: " + error.message());
                              return;
                            }
                            self->buffer_.consume(n);
                            self->read(kRequestTimeout);
                          },
                          stream_.get_executor()));
  }

 private:
  void read(std::chrono::seconds time) {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    stream_.next_layer().expires_after(time);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](const error_code& error, size_t) {
                       if (error) {
                         self->on_bad_request(error);
                       } else {
                         self->on_request();
                       }
                     });
  }

  void on_bad_request(const error_code& error) {
    // A browser that keeps a connection open without further requests is not a fault.
    if (error == beast::error::timeout && !has_requested_) note_refusal(kNoRequest);
    const bool is_http_error =
        error.category() == http::make_error_code(http::error::bad_method).category();
    if (!is_http_error || error == http::error::end_of_stream ||
        error == http::error::partial_message) {
      return;
    }
    ++context_.counters.num_violations;
    note_refusal("HTTP: " + error.message());
    keeps_alive_ = false;
    send(refusal(error == http::error::header_limit ? 431 : 400, "The request is not valid HTTP."));
  }

  void on_request() {
    has_requested_ = true;
    ++context_.counters.num_http_requests;
    const WebRequest& request = parser_->get();
    // RFC 9112, 9.3: the client may ask to close the connection after the response.
    keeps_alive_ = request.keep_alive();
    is_head_ = request.method() == http::verb::head;
    const std::string_view host = view(request[http::field::host]);
    if (context_.rules && !context_.rules->is_known_host(host)) {
      ++context_.counters.num_refused_hosts;
      note_refusal("Host header: unknown name.");
      send(refusal(421,
                   "This is not a name of the gateway: use its IP address, or start it with "
                   "--host-name."));
      return;
    }
    // RFC 9112, 3.2. Which of them a proxy before us has looked at is not known.
    if (request.count(http::field::host) > 1 || request.count(http::field::origin) > 1) {
      note_refusal("HTTP: several Host or Origin headers.");
      send(refusal(400, "A request has one Host header and at most one Origin header."));
      return;
    }
    const std::string_view target = view(request.target());
    if (target == "/ws" || target.substr(0, 4) == "/ws?") {
      on_websocket_request(host);
      return;
    }
    if (context_.is_https_only && !stream_.is_secure()) {
      PageResponse response = refusal(308, "This server speaks https.");
      response.headers.emplace_back("Location",
                                    "https://" + std::string(host) + std::string(target));
      send(std::move(response));
      return;
    }
    PageRequest page;
    page.method = std::string(view(request.method_string()));
    page.target = std::string(target);
    page.accept_encoding = std::string(view(request[http::field::accept_encoding]));
    page.if_none_match = std::string(view(request[http::field::if_none_match]));
    page.is_local = endpoint_.is_local;
    PageResponse response = context_.pages.respond(page);
    if (response.status == 400) note_refusal("HTTP: the target is not a path.");
    if (response.status == 403) note_refusal("HTTP: the page is for this host only.");
    send(std::move(response));
  }

  void on_websocket_request(std::string_view host) {
    WebRequest request = parser_->release();
    if (!beast::websocket::is_upgrade(request)) {
      PageResponse response = refusal(426, "This path is for WebSockets only.");
      // RFC 9110, 15.5.22: a 426 response names the protocol.
      response.headers.emplace_back("Upgrade", "websocket");
      send(std::move(response));
      return;
    }
    if (context_.rules && !context_.rules->is_known_origin(view(request[http::field::origin]), host,
                                                           stream_.is_secure())) {
      ++context_.counters.num_refused_origins;
      note_refusal("Origin header: another site.");
      send(refusal(403, "Pages of other sites may not connect."));
      return;
    }
    handshake_.reset();
    context_.serve_websocket(std::move(stream_), std::move(request));
  }

  void note_refusal(const std::string& why) { context_.note_refusal(endpoint_.address, why); }

  static PageResponse refusal(int status, const std::string& text) {
    PageResponse response;
    response.status = status;
    response.headers = {{"Content-Type", "text/plain; charset=utf-8"}};
    response.body = std::make_shared<const std::string>(text + "\n");
    return response;
  }

  void send(PageResponse page) {
    // Kept until it is sent: the response refers to its body.
    page_ = std::move(page);
    response_.emplace(static_cast<http::status>(page_.status), kHttpVersion);
    response_->set(http::field::server, context_.name + "/" + version());
    response_->set("X-Content-Type-Options", "nosniff");
    // The address of the page may contain the pairing token.
    response_->set("Referrer-Policy", "no-referrer");
    for (const auto& [name, value] : page_.headers) response_->set(name, value);
    response_->keep_alive(keeps_alive_);
    if (page_.status != 304) response_->content_length(page_.body->size());
    if (!is_head_) {
      response_->body() = beast::span<const char>(page_.body->data(), page_.body->size());
    }
    serializer_.emplace(*response_);
    stream_.next_layer().expires_after(kResponseTimeout);
    const auto on_sent = [self = shared_from_this()](const error_code& error, size_t) {
      if (error) return;
      if (self->keeps_alive_) {
        self->read(kKeepAliveTimeout);
      } else {
        self->close();
      }
    };
    if (is_head_ || page_.status == 304) {
      http::async_write_header(stream_, *serializer_, on_sent);
    } else {
      http::async_write(stream_, *serializer_, on_sent);
    }
  }

  void close() {
    error_code ignored;
    stream_.next_layer().socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  using Response = http::response<http::span_body<const char>>;

  HttpContext& context_;
  WebStream stream_;
  beast::flat_buffer buffer_;
  Endpoint endpoint_;
  std::optional<HandshakeGuard> handshake_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  bool has_requested_ = false;
  bool keeps_alive_ = false;
  bool is_head_ = false;
  PageResponse page_;
  std::optional<Response> response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
};

/** Detects from a connection's first bytes whether it uses TLS or plain HTTP. */
class TlsDetector : public std::enable_shared_from_this<TlsDetector> {
 public:
  TlsDetector(HttpContext& context, Tcp::socket socket)
      : context_(context), stream_(std::move(socket)) {}

  void start() {
    const auto weak = weak_from_this();
    address_ = make_endpoint(stream_.socket(), "").address;
    handshake_.emplace(context_, address_, [weak] {
      if (const auto self = weak.lock()) self->stream_.cancel();
    });
    stream_.expires_after(kRequestTimeout);
    beast::async_detect_ssl(stream_, buffer_,
                            [self = shared_from_this()](const error_code& error, bool is_tls) {
                              if (!error) self->serve(is_tls);
                              if (error == beast::error::timeout) {
                                self->context_.note_refusal(self->address_, kNoRequest);
                              }
                            });
  }

 private:
  void serve(bool is_tls) {
    handshake_.reset();
    WebStream stream =
        is_tls ? WebStream(std::move(stream_), *context_.tls) : WebStream(std::move(stream_));
    std::make_shared<HttpConnection>(context_, std::move(stream), std::move(buffer_))->start();
  }

  HttpContext& context_;
  std::string address_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<HandshakeGuard> handshake_;
};

}  // namespace

void note_eviction(HttpContext& context, const std::string& address) {
  ++context.counters.num_evicted;
  context.note_refusal(address, "Too many connections without Connect.");
}

void serve_http(HttpContext& context, Tcp::socket socket) {
  if (context.tls) {
    std::make_shared<TlsDetector>(context, std::move(socket))->start();
  } else {
    std::make_shared<HttpConnection>(context, WebStream(beast::tcp_stream(std::move(socket))),
                                     beast::flat_buffer())
        ->start();
  }
}

}  // namespace nao::gateway
