#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "phone-gateway/server/core/audit_event.h"
#include "phone-gateway/server/core/client_session.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"

namespace nao::gateway {

/** The sessions of all connections: opens, connects and closes them, and closes those that are
 * silent, do not connect in time, or do not read what they are sent. */
class Sessions {
 public:
  /** By ascending id, in one piece of memory: it is gone through for every message of a robot. */
  using List = std::vector<std::pair<uint32_t, std::unique_ptr<ClientSession>>>;

  Sessions(const GatewayLimits& limits, std::function<void(const AuditEvent&)> audit)
      : limits_(limits), audit_(std::move(audit)) {}

  /** Sets what is called when a connected client disconnects, before its session is destroyed. */
  void on_disconnect(std::function<void(const ClientSession&, double now)> handler) {
    on_disconnect_ = std::move(handler);
  }

  /** Opens a session for an accepted connection. @return Its id, counted up from 1. */
  uint32_t open(Endpoint endpoint, std::function<void()> wake, double now);

  /** @return nullptr if there is no such session. */
  ClientSession* find(uint32_t id) const;

  /** Connect has been accepted: the client gets a name that no other client has. */
  void connect(ClientSession& session, const naoremote::Connect& request);
  /** Connect has been refused: the connection closes. */
  void refuse(ClientSession& session, const naoremote::Connect& request, const Reason& reason,
              double now);

  /** Join has been accepted: `second` is the second connection of the client of `first`; one that
   * it had before closes. */
  void join(ClientSession& first, ClientSession& second, double now);
  /** The session of a connection's client: its own, or that of the first connection; nullptr if
   * that has ended. */
  ClientSession* client_of(ClientSession& connection) const {
    return connection.first == 0 ? &connection : find(connection.first);
  }

  /** Closes a session from the gateway's side, with a notice that says why. */
  void close(ClientSession& session, const Reason& reason, double now);
  /** The connection has ended. @param why  For the audit log. */
  void remove(uint32_t id, const std::string& why, double now);

  /** Sends a message to every connected client. */
  void broadcast(const naoremote::ServerMessage& message) const;

  /** Closes the sessions that exceed a limit. */
  void step(double now);

  const List& all() const { return sessions_; }
  int num_connected() const;
  /** Connected clients of one address. */
  int num_connected_from(const std::string& address) const;
  /** Sums over all clients, including those that have disconnected. */
  ClientCounters calc_counters() const;

  void audit(const std::string& event, const ClientSession& session, const std::string& detail);

 private:
  /** The client no longer counts as connected. */
  void disconnect(ClientSession& session, const std::string& why, double now);
  List::const_iterator position_of(uint32_t id) const;
  std::string make_unique_name(const std::string& requested, uint32_t id) const;

  GatewayLimits limits_;
  std::function<void(const AuditEvent&)> audit_;
  std::function<void(const ClientSession&, double)> on_disconnect_;
  List sessions_;
  uint32_t last_id_ = 0;
  /** s. */
  double next_check_ = 0;
  /** Counters of the clients that have disconnected. */
  ClientCounters past_counters_;
};

}  // namespace nao::gateway
