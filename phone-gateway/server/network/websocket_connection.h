#pragma once

#include "phone-gateway/server/network/connection_context.h"

namespace nao::gateway {

/** Accepts a WebSocket whose Host and Origin have been checked, and serves it until it ends. */
void serve_websocket(ConnectionContext& context, WebStream stream, WebRequest request);

}  // namespace nao::gateway
