#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/rate_limiter.h"
#include "phone-gateway/web_stream/access_rules.h"
#include "tools/foxglove/asset_folder.h"
#include "tools/foxglove/server_core.h"

namespace nao::foxglove {

/** What all connections share. */
struct ConnectionContext {
  boost::asio::io_context& io;
  ServerCore& core;
  AssetFolder& files;
  AccessRules rules;
  /** Also those pages may open a WebSocket that people use for looking at a robot: the published
   * Foxglove and Lichtblick, and pages from this computer. */
  bool accepts_viewers = false;
  /** s, monotonic: of refused pages in the log. Chosen: a person reads it, a page cannot fill it.
   */
  RateLimiter refusals{10.0};
  size_t num_connections = 0;
  /** The core must no longer be called. */
  bool is_shutting_down = false;
};

/** Serves an accepted connection until it ends: files over HTTP, or a WebSocket. */
void serve(ConnectionContext& context, boost::asio::ip::tcp::socket socket);

}  // namespace nao::foxglove
