#include "tools/foxglove/connection.h"
//
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <optional>

#include "common/logger.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "messages/command.h"
#include "phone-gateway/web_stream/web_stream.h"

namespace nao::foxglove {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using boost::system::error_code;
using Request = http::request<http::empty_body>;

// Time for a request and its response, and for the handshakes of a WebSocket. Chosen: a program on
// the same network needs milliseconds.
constexpr std::chrono::seconds kHttpTimeout{10};
// A client that has been silent for half of this time is asked (ping); one that does not answer is
// disconnected.
constexpr std::chrono::seconds kIdleTimeout{30};
// Largest message of a client, bytes. Chosen: subscriptions to 1000 channels.
constexpr size_t kMaxRequestBytes = 65536;
constexpr uint32_t kMaxHeaderBytes = 8192;
// Bytes that the kernel holds unsent before it takes no more, so that messages of a slow client
// wait where newer ones replace them. Chosen: a few messages.
constexpr int kMaxUnsentBytes = 65536;
constexpr std::string_view kFilePrefix = "/robot/";
constexpr const char* kHelp =
    "nao-foxglove: connect Foxglove or Lichtblick to this address with ws:// instead of http://.\n"
    "The robot's model: /robot/robot.urdf\n";

/** Pages with which people look at a robot: Foxglove's and Lichtblick's published ones, and those
 * of their desktop programs, which are files. Sources: https://app.foxglove.dev,
 * https://lichtblick-suite.github.io/lichtblick; Chromium's origin of a file. */
constexpr std::array<std::string_view, 3> kViewerOrigins = {
    "https://app.foxglove.dev", "https://lichtblick-suite.github.io", "file://"};

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

/** A client of the protocol. */
class Client : public std::enable_shared_from_this<Client> {
 public:
  Client(ConnectionContext& context, WebStream stream)
      : context_(context), socket_(std::move(stream)) {}
  ~Client() {
    --context_.num_connections;
    if (id_ != 0 && !context_.is_shutting_down) context_.core.close(id_);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void start(Request request, const std::string& subprotocol) {
    request_ = std::move(request);
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout{kHttpTimeout, kIdleTimeout, true});
    socket_.set_option(
        websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
          response.set(http::field::server, std::string("nao-foxglove/") + version());
          response.set(http::field::sec_websocket_protocol, subprotocol);
        }));
    socket_.read_message_max(kMaxRequestBytes);
    socket_.auto_fragment(false);
    socket_.async_accept(request_, [self = shared_from_this()](const error_code& error) {
      if (!error) self->open();
    });
  }

 private:
  void open() {
    const auto wake = [weak = weak_from_this()] {
      const auto self = weak.lock();
      // One flush for all messages of an event.
      if (!self || std::exchange(self->is_flush_posted_, true)) return;
      asio::post(self->context_.io, [self] {
        self->is_flush_posted_ = false;
        self->flush();
      });
    };
    id_ = context_.core.open(wake);
    if (id_ == 0) {
      socket_.async_close({websocket::close_code::try_again_later, "too many clients"},
                          [self = shared_from_this()](const error_code&) {});
      return;
    }
    logger::info("client {} connected: {} clients", id_, context_.core.num_clients());
    read();
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](const error_code& error, size_t) {
      if (error) return self->finish(error.message());
      const std::string_view message(static_cast<const char*>(self->buffer_.data().data()),
                                     self->buffer_.size());
      if (self->socket_.got_text()) {
        self->context_.core.receive_text(self->id_, message);
      } else {
        self->context_.core.receive_binary(self->id_, message);
      }
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  void flush() {
    if (is_writing_ || is_finished_) return;
    if (context_.core.must_close(id_)) return finish("it does not read its messages");
    auto message = context_.core.next_message(id_);
    if (!message) return;
    outgoing_ = std::move(*message);
    is_writing_ = true;
    socket_.text(outgoing_.is_text);
    const std::array<asio::const_buffer, 2> parts{
        asio::buffer(outgoing_.head),
        outgoing_.body ? asio::buffer(*outgoing_.body) : asio::const_buffer()};
    socket_.async_write(parts, [self = shared_from_this()](const error_code& error, size_t) {
      self->is_writing_ = false;
      if (error) return self->finish(error.message());
      self->flush();
    });
  }

  void finish(const std::string& why) {
    if (std::exchange(is_finished_, true)) return;
    logger::info("client {} disconnected: {}", id_, why);
    beast::get_lowest_layer(socket_).close();
  }

  ConnectionContext& context_;
  websocket::stream<WebStream> socket_;
  Request request_;
  beast::flat_buffer buffer_;
  OutgoingMessage outgoing_;
  uint32_t id_ = 0;
  bool is_flush_posted_ = false;
  bool is_writing_ = false;
  bool is_finished_ = false;
};

/** A connection that has not become a WebSocket: answers requests for files. */
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(ConnectionContext& context, Tcp::socket socket)
      : context_(context), stream_(beast::tcp_stream(std::move(socket))) {
    ++context_.num_connections;
  }
  ~HttpConnection() {
    if (!is_handed_over_) --context_.num_connections;
  }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    stream_.next_layer().expires_after(kHttpTimeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](const error_code& error, size_t) {
                       if (!error) self->on_request(self->parser_->get());
                     });
  }

 private:
  void on_request(const Request& request) {
    if (!context_.rules.is_known_host(view(request[http::field::host]))) {
      return refuse(http::status::misdirected_request, "the name", view(request[http::field::host]),
                    "--host-name");
    }
    // RFC 9112, 3.2. Which of them a proxy before us has looked at is not known.
    if (request.count(http::field::host) > 1 || request.count(http::field::origin) > 1) {
      return respond(http::status::bad_request, "text/plain", "One Host, at most one Origin.\n");
    }
    if (websocket::is_upgrade(request)) return on_upgrade(request);
    const std::string_view target = view(request.target());
    const bool is_get = request.method() == http::verb::get;
    if (!is_get && request.method() != http::verb::head) {
      return respond(http::status::method_not_allowed, "text/plain", "Only GET and HEAD.\n");
    }
    if (target == "/") return respond(http::status::ok, "text/plain", kHelp);
    const std::shared_ptr<const std::string> file =
        target.starts_with(kFilePrefix) ? context_.files.read(target.substr(kFilePrefix.size()))
                                        : nullptr;
    if (!file) return respond(http::status::not_found, "text/plain", "Not found.\n");
    respond(http::status::ok, content_type(target), *file);
  }

  void on_upgrade(const Request& request) {
    const std::string_view origin = view(request[http::field::origin]);
    if (!is_known_origin(origin, view(request[http::field::host]))) {
      return refuse(http::status::forbidden, "pages of", origin, "--allow-origin");
    }
    const auto subprotocol = choose_subprotocol(view(request[http::field::sec_websocket_protocol]));
    if (!subprotocol) {
      return respond(http::status::bad_request, "text/plain",
                     "The WebSocket must offer the subprotocol foxglove.sdk.v1 or "
                     "foxglove.websocket.v1.\n");
    }
    is_handed_over_ = true;
    std::make_shared<Client>(context_, std::move(stream_))->start(parser_->release(), *subprotocol);
  }

  bool is_known_origin(std::string_view origin, std::string_view host) const {
    if (context_.rules.is_known_origin(origin, host, false)) return true;
    return context_.accepts_viewers && (is_origin_on_this_computer(origin) ||
                                        std::find(kViewerOrigins.begin(), kViewerOrigins.end(),
                                                  origin) != kViewerOrigins.end());
  }

  /** Answers and logs why this client is not served, and which option would change that. */
  void refuse(http::status status, const std::string& what, std::string_view value,
              const std::string& option) {
    const std::string text = "nao-foxglove does not answer " + what + " " +
                             quoted(std::string(value)) + "; " + option + " allows it";
    if (const auto num_suppressed = context_.refusals.allow(monotonic_seconds())) {
      logger::warn("{} ({} more such refusals)", text, *num_suppressed);
    }
    respond(status, "text/plain", text + "\n");
  }

  void respond(http::status status, const std::string& type, std::string body) {
    const Request& request = parser_->get();
    response_ = {};
    response_.version(request.version());
    response_.result(status);
    response_.set(http::field::content_type, type);
    // Pages of any site may read what is served here: it is public.
    response_.set(http::field::access_control_allow_origin, "*");
    response_.keep_alive(request.keep_alive());
    response_.content_length(body.size());
    if (request.method() != http::verb::head) response_.body() = std::move(body);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](const error_code& error, size_t) {
                        if (!error && self->response_.keep_alive()) self->read();
                      });
  }

  ConnectionContext& context_;
  WebStream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
  bool is_handed_over_ = false;
};

}  // namespace

void serve(ConnectionContext& context, Tcp::socket socket) {
  error_code ignored;
  socket.set_option(Tcp::no_delay(true), ignored);
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kMaxUnsentBytes,
             sizeof kMaxUnsentBytes);
  std::make_shared<HttpConnection>(context, std::move(socket))->read();
}

}  // namespace nao::foxglove
