#pragma once

#include "phone-gateway/server/network/connection_context.h"
//
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/ssl.hpp>

namespace nao::gateway {

namespace beast = boost::beast;
namespace http = boost::beast::http;

using PlainStream = beast::tcp_stream;
using SecureStream = beast::ssl_stream<beast::tcp_stream>;
using WebRequest = http::request<http::empty_body>;

/** Accepts a WebSocket whose Host and Origin have been checked, and serves it until it ends. */
void serve_websocket(ConnectionContext& context, PlainStream stream, WebRequest request);
void serve_websocket(ConnectionContext& context, SecureStream stream, WebRequest request);

}  // namespace nao::gateway
