#pragma once

#include "phone-gateway/server/network/http_server.h"
//
#include <boost/beast/websocket.hpp>
#include <chrono>

namespace nao::relay {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using gateway::WebRequest;

/** Without compression: the bytes are encrypted. */
using WebSocket = websocket::stream<WebStream, false>;

/** Time for opening and closing a WebSocket, as at the gateway. */
inline constexpr std::chrono::seconds kHandshakeTimeout{5};
/** Sets time limits. @param silence  After which the other end has gone. @param pings  Sent after
 * half of it, so that a silent end is not taken for one that has gone. */
inline void prepare(WebSocket& socket, std::chrono::seconds silence, bool pings) {
  beast::get_lowest_layer(socket).expires_never();
  socket.set_option(websocket::stream_base::timeout{kHandshakeTimeout, silence, pings});
  socket.auto_fragment(false);
  socket.binary(true);
}

}  // namespace nao::relay
