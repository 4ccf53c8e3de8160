#pragma once

#include <memory>

#include "phone-gateway/server/core/gateway_core.h"
#include "phone-gateway/server/network/fair_queue.h"
#include "phone-gateway/server/network/http_server.h"
#include "phone-gateway/server/network/network.h"
#include "phone-gateway/server/network/sockets.h"

namespace nao::gateway {

class ClientConnection;

/** The objects that all connections of the gateway share. */
struct ConnectionContext : HttpContext {
  GatewayCore& core;
  /** Connections with something to send: all of one event are served in one iteration. */
  FairQueue<std::weak_ptr<ClientConnection>> flush_queue;
  /** Transmissions of images: a state that arrives in the meantime must not wait for all of them.
   */
  FairQueue<std::weak_ptr<ClientConnection>> image_queue;
  /** The network is being destroyed: connections no longer report their end to the core. */
  bool is_shutting_down = false;
};

/** Serves a connection of the raw TCP port until it ends. */
void serve_tcp(ConnectionContext& context, Tcp::socket socket);

}  // namespace nao::gateway
