#pragma once

#include "phone-gateway/web_stream/web_stream.h"
//
#include <boost/asio/io_context.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "phone-gateway/server/http/web_pages.h"
#include "phone-gateway/server/network/handshake_limiter.h"
#include "phone-gateway/server/network/network_counters.h"
#include "phone-gateway/server/network/sockets.h"
#include "phone-gateway/web_stream/access_rules.h"

namespace nao::gateway {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

using WebRequest = http::request<http::empty_body>;

/** What the connections of a server of pages and WebSockets share. */
struct HttpContext {
  asio::io_context& io;
  /** Of the Server header. */
  std::string name;
  WebPages& pages;
  /** None: every Host is served, and every Origin. */
  std::optional<AccessRules> rules;
  /** Null without https. */
  std::unique_ptr<asio::ssl::context> tls;
  HandshakeLimiter handshakes;
  NetworkCounters counters;
  /** Gets each refusal: address, and why, a fixed text. */
  std::function<void(const std::string&, const std::string&)> note_refusal;
  /** Takes over a connection that asks for a WebSocket at /ws, and may from its Host and Origin. */
  std::function<void(WebStream, WebRequest)> serve_websocket;
  /** Pages are served over https only; requests without are sent there. */
  bool is_https_only = false;
};

/** Counts and reports an eviction by the handshake limiter. */
void note_eviction(HttpContext& context, const std::string& address);

/** Serves a connection until it ends, or becomes a WebSocket. */
void serve_http(HttpContext& context, Tcp::socket socket);

}  // namespace nao::gateway
