#pragma once

#include <string>

namespace nao::gateway {

/** The other end of a connection. */
struct Endpoint {
  /** IP address without port. */
  std::string address;
  /** "websocket" or "tcp". */
  std::string transport;
  /** On the gateway's own host. */
  bool is_local = false;
};

}  // namespace nao::gateway
