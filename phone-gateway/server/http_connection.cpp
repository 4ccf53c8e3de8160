#include "phone-gateway/server/beast_streams.h"
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

namespace nao {
namespace {

using boost::system::error_code;

/** How long a client may take for TLS and its first request, and for the next one. */
constexpr std::chrono::seconds kRequestTime{5};
constexpr std::chrono::seconds kKeepAliveTime{15};
/** How long one answer may take to leave. */
constexpr std::chrono::seconds kAnswerTime{30};
constexpr uint32_t kMaxHeaderBytes = 8192;
constexpr const char* kNoRequest = "No request within 5 s.";

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

PlainStream& lowest(PlainStream& stream) {
  return stream;
}
PlainStream& lowest(SecureStream& stream) {
  return stream.next_layer();
}

/** A place in the waiting room, held as long as this lives. */
class WaitingPlace {
 public:
  WaitingPlace(Hub& hub, const std::string& address, std::function<void()> evict) : hub_(hub) {
    if (hub_.waiting_room.enter(address, std::move(evict), place_)) note_eviction(hub_, address);
  }
  ~WaitingPlace() { hub_.waiting_room.leave(place_); }
  WaitingPlace(const WaitingPlace&) = delete;
  WaitingPlace& operator=(const WaitingPlace&) = delete;

 private:
  Hub& hub_;
  WaitingRoom::Place place_;
};

/** A web connection: answers one request after the other, until one asks for a WebSocket. */
template <class Stream>
class HttpConnection : public std::enable_shared_from_this<HttpConnection<Stream>> {
 public:
  HttpConnection(Hub& hub, Stream stream, beast::flat_buffer buffer)
      : hub_(hub), stream_(std::move(stream)), buffer_(std::move(buffer)) {}

  void start() {
    peer_ = make_peer(lowest(stream_).socket(), "websocket");
    const auto weak = this->weak_from_this();
    waiting_.emplace(hub_, peer_.address, [weak] {
      // Ends what is under way with an error, and with it the connection.
      if (const auto self = weak.lock()) lowest(self->stream_).cancel();
    });
    if constexpr (std::is_same_v<Stream, SecureStream>) {
      lowest(stream_).expires_after(kRequestTime);
      stream_.async_handshake(asio::ssl::stream_base::server, buffer_.data(),
                              [self = this->shared_from_this()](const error_code& error, size_t n) {
                                if (error) {
                                  self->note_refusal("TLS: " + error.message());
                                  return;
                                }
                                self->buffer_.consume(n);
                                self->read(kRequestTime);
                              });
    } else {
      read(kRequestTime);
    }
  }

 private:
  static constexpr bool kIsSecure = std::is_same_v<Stream, SecureStream>;

  void read(std::chrono::seconds time) {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    lowest(stream_).expires_after(time);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](const error_code& error, size_t) {
                       if (error) {
                         self->on_bad_request(error);
                       } else {
                         self->on_request();
                       }
                     });
  }

  void on_bad_request(const error_code& error) {
    if (error == beast::error::timeout && !has_asked_) note_refusal(kNoRequest);
    const bool is_http_error =
        error.category() == http::make_error_code(http::error::bad_method).category();
    if (!is_http_error || error == http::error::end_of_stream ||
        error == http::error::partial_message) {
      return;
    }
    ++hub_.counters.num_violations;
    note_refusal("HTTP: " + error.message());
    keeps_alive_ = false;
    send(refusal(error == http::error::header_limit ? 431 : 400, "This is no request for here."));
  }

  void on_request() {
    has_asked_ = true;
    ++hub_.counters.num_http_requests;
    const WebRequest& request = parser_->get();
    keeps_alive_ = request.keep_alive();
    is_head_ = request.method() == http::verb::head;
    const std::string_view host = view(request[http::field::host]);
    if (!hub_.rules.is_known_host(host)) {
      ++hub_.counters.num_refused_hosts;
      note_refusal("Host is no name of this gateway.");
      send(refusal(421,
                   "This gateway does not go by that name: use its IP address, or start it "
                   "with --host-name."));
      return;
    }
    const std::string_view target = view(request.target());
    if (target == "/ws" || target.substr(0, 4) == "/ws?") {
      on_websocket_request(host);
      return;
    }
    WebQuestion question;
    question.method = std::string(view(request.method_string()));
    question.target = std::string(target);
    question.accept_encoding = std::string(view(request[http::field::accept_encoding]));
    question.if_none_match = std::string(view(request[http::field::if_none_match]));
    question.is_local = peer_.is_local;
    WebAnswer answer = hub_.pages.answer(question);
    if (answer.status == 400) note_refusal("HTTP: the target is no path.");
    if (answer.status == 403) note_refusal("HTTP: a page for this host only.");
    send(std::move(answer));
  }

  void on_websocket_request(std::string_view host) {
    WebRequest request = parser_->release();
    if (!beast::websocket::is_upgrade(request)) {
      WebAnswer answer = refusal(426, "This is the place of a WebSocket.");
      answer.headers.emplace_back("Upgrade", "websocket");
      send(std::move(answer));
      return;
    }
    if (!hub_.rules.is_known_origin(view(request[http::field::origin]), host, kIsSecure)) {
      ++hub_.counters.num_refused_origins;
      note_refusal("Origin is another site.");
      send(refusal(403, "Pages from elsewhere may not drive this robot."));
      return;
    }
    waiting_.reset();
    serve_websocket(hub_, std::move(stream_), std::move(request));
  }

  void note_refusal(const std::string& why) { hub_.core.note_refusal(peer_.address, why); }

  static WebAnswer refusal(int status, const std::string& text) {
    WebAnswer answer;
    answer.status = status;
    answer.headers = {{"Content-Type", "text/plain; charset=utf-8"}};
    answer.body = std::make_shared<const std::string>(text + "\n");
    return answer;
  }

  void send(WebAnswer answer) {
    answer_ = std::move(answer);
    response_.emplace(static_cast<http::status>(answer_.status), 11);
    response_->set(http::field::server, std::string("nao-phone-gateway/") + version());
    response_->set("X-Content-Type-Options", "nosniff");
    // The address of the page may hold the token.
    response_->set("Referrer-Policy", "no-referrer");
    for (const auto& [name, value] : answer_.headers) response_->set(name, value);
    response_->keep_alive(keeps_alive_);
    if (answer_.status != 304) response_->content_length(answer_.body->size());
    if (!is_head_) {
      response_->body() = beast::span<const char>(answer_.body->data(), answer_.body->size());
    }
    serializer_.emplace(*response_);
    lowest(stream_).expires_after(kAnswerTime);
    const auto on_sent = [self = this->shared_from_this()](const error_code& error, size_t) {
      if (error) return;
      if (self->keeps_alive_) {
        self->read(kKeepAliveTime);
      } else {
        self->close();
      }
    };
    if (is_head_ || answer_.status == 304) {
      http::async_write_header(stream_, *serializer_, on_sent);
    } else {
      http::async_write(stream_, *serializer_, on_sent);
    }
  }

  void close() {
    error_code ignored;
    lowest(stream_).socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  using Response = http::response<http::span_body<const char>>;

  Hub& hub_;
  Stream stream_;
  beast::flat_buffer buffer_;
  Peer peer_;
  std::optional<WaitingPlace> waiting_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  bool has_asked_ = false;
  bool keeps_alive_ = false;
  bool is_head_ = false;
  WebAnswer answer_;
  std::optional<Response> response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
};

/** Tells TLS from plain HTTP by a connection's first bytes. */
class FirstBytes : public std::enable_shared_from_this<FirstBytes> {
 public:
  FirstBytes(Hub& hub, Tcp::socket socket) : hub_(hub), stream_(std::move(socket)) {}

  void start() {
    const auto weak = weak_from_this();
    address_ = make_peer(stream_.socket(), "").address;
    waiting_.emplace(hub_, address_, [weak] {
      if (const auto self = weak.lock()) self->stream_.cancel();
    });
    stream_.expires_after(kRequestTime);
    beast::async_detect_ssl(stream_, buffer_,
                            [self = shared_from_this()](const error_code& error, bool is_tls) {
                              if (!error) self->go_on(is_tls);
                              if (error == beast::error::timeout) {
                                self->hub_.core.note_refusal(self->address_, kNoRequest);
                              }
                            });
  }

 private:
  void go_on(bool is_tls) {
    waiting_.reset();
    if (is_tls) {
      std::make_shared<HttpConnection<SecureStream>>(
          hub_, SecureStream(std::move(stream_), *hub_.tls), std::move(buffer_))
          ->start();
    } else {
      std::make_shared<HttpConnection<PlainStream>>(hub_, std::move(stream_), std::move(buffer_))
          ->start();
    }
  }

  Hub& hub_;
  std::string address_;
  PlainStream stream_;
  beast::flat_buffer buffer_;
  std::optional<WaitingPlace> waiting_;
};

}  // namespace

void serve_http(Hub& hub, Tcp::socket socket) {
  if (hub.tls) {
    std::make_shared<FirstBytes>(hub, std::move(socket))->start();
  } else {
    std::make_shared<HttpConnection<PlainStream>>(hub, PlainStream(std::move(socket)),
                                                  beast::flat_buffer())
        ->start();
  }
}

}  // namespace nao
