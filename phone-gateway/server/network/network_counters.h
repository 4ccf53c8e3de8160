#pragma once

#include <cstdint>

namespace nao::gateway {

/** Counters of the network layer since the start. */
struct NetworkCounters {
  int64_t num_accepted = 0;
  int64_t num_http_requests = 0;
  int64_t num_refused_hosts = 0;
  int64_t num_refused_origins = 0;
  /** Connections that the handshake limiter has closed. */
  int64_t num_evicted = 0;
  /** Connections closed because they violated HTTP, WebSocket or the framing. */
  int64_t num_violations = 0;
};

}  // namespace nao::gateway
