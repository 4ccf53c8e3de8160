#pragma once

#include "phone-gateway/server/network/connection_context.h"
#include "phone-gateway/web_stream/web_stream.h"
//
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

namespace nao::gateway {

namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

using WebRequest = http::request<http::empty_body>;

/** Accepts a WebSocket whose Host and Origin have been checked, and serves it until it ends. */
void serve_websocket(ConnectionContext& context, WebStream stream, WebRequest request);

}  // namespace nao::gateway
