#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "phone-gateway/server/core/gateway_core.h"
#include "phone-gateway/server/core/metric.h"
#include "phone-gateway/server/http/web_pages.h"
#include "phone-gateway/server/network/network_counters.h"
#include "phone-gateway/web_stream/access_rules.h"

namespace nao {
class AsioLoop;
}

namespace nao::gateway {

/** Addresses, ports and certificate of the gateway. */
struct NetworkOptions {
  /** Address to listen on; "0.0.0.0" for all, of IPv4 and IPv6. */
  std::string bind = "0.0.0.0";
  /** 0: the system chooses, see Network::http_port(). */
  uint16_t http_port = 8080;
  uint16_t tcp_port = 7668;
  /** Certificate and its key, PEM; empty: no https. */
  std::string certificate_file;
  std::string key_file;
  /** TCP congestion control of the clients' connections, as tcp(7) names it; empty: the system's
   * default, also where the system does not have it or does not permit it. */
  std::string congestion_control;
  /** HOST[:PORT] of the relay to dial, and the file of its invitations; empty: none. */
  std::string relay;
  std::string relay_file;
  /** Name by which phones find it by Bluetooth; empty: no Bluetooth. */
  std::string bluetooth_name;
};

/** The gateway's sockets and their loop: HTTP and WebSocket on one port, raw TCP on another. */
class Network {
 public:
  /** Starts to listen. Core and pages must outlive this.
   * @throws Error  naming the port or address that cannot be used, or the certificate's file. */
  Network(const NetworkOptions& options, AccessRules rules, GatewayCore& core, WebPages& pages);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  uint16_t http_port() const;
  uint16_t tcp_port() const;
  const NetworkCounters& counters() const;
  /** The counters as metrics. */
  std::vector<Metric> metrics() const;

  /** Calls `handler` for each connection that is accepted. */
  void on_accepted(std::function<void()> handler);

  /** The loop that the connections run in. */
  AsioLoop& loop();

  /** Closes the listening sockets and runs for up to `time` seconds, so that queued messages are
   * sent. */
  void drain(double time);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao::gateway
