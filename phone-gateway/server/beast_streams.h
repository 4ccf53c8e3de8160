#pragma once

#include "phone-gateway/server/connection.h"
//
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/ssl.hpp>

namespace nao {

namespace beast = boost::beast;
namespace http = boost::beast::http;

using PlainStream = beast::tcp_stream;
using SecureStream = beast::ssl_stream<beast::tcp_stream>;
using WebRequest = http::request<http::empty_body>;

/** Answers a request for a WebSocket, which has been judged to be allowed, and serves it. */
void serve_websocket(Hub& hub, PlainStream stream, WebRequest request);
void serve_websocket(Hub& hub, SecureStream stream, WebRequest request);

}  // namespace nao
