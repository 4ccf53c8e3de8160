#pragma once

#include <string>

namespace nao::gateway {

/** The other end of a connection. */
struct Endpoint {
  /** IP address without port. */
  std::string address;
  /** "websocket", "tcp", "relay" or "bluetooth". */
  std::string transport;
  /** On the gateway's own host. */
  bool is_local = false;
  /** By an invitation, which has been checked: it needs no token, and its address is that. */
  bool is_invited = false;
  /** The invitation is for watching only. */
  bool is_watcher = false;
  /** The invitation is for operating: as the operator's console, and it need not ask for control.
   */
  bool is_operator = false;
};

}  // namespace nao::gateway
