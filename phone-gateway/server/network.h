#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "phone-gateway/server/access_rules.h"
#include "phone-gateway/server/gateway_core.h"
#include "phone-gateway/server/metric.h"
#include "phone-gateway/server/web_pages.h"

namespace nao {

/** Where the gateway listens. */
struct NetworkOptions {
  /** Address to listen on; "0.0.0.0" for all. */
  std::string bind = "0.0.0.0";
  /** 0: the system chooses, see Network::http_port(). */
  uint16_t http_port = 8080;
  uint16_t tcp_port = 7668;
  /** Certificate and its key, PEM; empty: no https. */
  std::string certificate_file;
  std::string key_file;
};

/** What the network layer has counted since the start. */
struct NetworkCounters {
  int64_t num_accepted = 0;
  int64_t num_http_requests = 0;
  int64_t num_refused_hosts = 0;
  int64_t num_refused_origins = 0;
  /** Connections closed to make room: too many that had not said Connect yet. */
  int64_t num_evicted = 0;
  /** Connections that broke the framing, or asked for too much at once. */
  int64_t num_violations = 0;
};

/** The gateway's sockets and its main loop: HTTP and WebSocket on one port, raw TCP on another,
 * timers, other descriptors, SIGINT and SIGTERM, all in one thread. */
class Network {
 public:
  /** Listens from here on. Core and pages must outlive it.
   * @throws Error  if a port is in use or an address is not this host's; says which. */
  Network(const NetworkOptions& options, AccessRules rules, GatewayCore& core, WebPages& pages);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  uint16_t http_port() const;
  uint16_t tcp_port() const;
  const NetworkCounters& counters() const;
  /** The same, by name. */
  std::vector<Metric> metrics() const;

  /** Calls `handler` whenever `descriptor` has something to read. The caller keeps it open. */
  void on_readable(int descriptor, std::function<void()> handler);

  /** Calls `handler` every `period` seconds. A late loop calls it once, not for each miss. */
  void every(double period, std::function<void()> handler);

  /** Runs until a signal or stop(). @return Why it ended: "SIGINT", "SIGTERM" or stop()'s reason.
   */
  std::string run();

  /** Ends run(), from within a handler. */
  void stop(const std::string& reason);

  /** Goes on for up to `time` seconds so that what is being sent gets out. */
  void drain(double time);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nao
