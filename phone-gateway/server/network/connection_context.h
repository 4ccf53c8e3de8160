#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "phone-gateway/server/network/fair_queue.h"
#include "phone-gateway/server/network/handshake_limiter.h"
#include "phone-gateway/server/network/network.h"

namespace nao::gateway {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

/** The objects that all connections share. */
struct ConnectionContext {
  asio::io_context& io;
  GatewayCore& core;
  WebPages& pages;
  AccessRules rules;
  /** Null without https. */
  std::unique_ptr<asio::ssl::context> tls;
  HandshakeLimiter handshakes;
  NetworkCounters counters;
  /** Transmissions of images. Those to 32 clients take 0.5 ms: a state that arrives in the meantime
   * must not wait for all of them. */
  FairQueue image_queue;
  /** The network is being destroyed: connections no longer report their end to the core. */
  bool is_shutting_down = false;
};

/** Counts and audits an eviction by the handshake limiter. */
void note_eviction(ConnectionContext& context, const std::string& address);

/** The other end of a socket. */
Endpoint make_endpoint(const Tcp::socket& socket, const std::string& transport);

/** Sets the options of an accepted socket: no delay, a small limit of unsent bytes, so that the
 * next image of a slow client is chosen late, and the congestion control (NetworkOptions). */
void prepare_socket(Tcp::socket& socket, const std::string& congestion_control);

/** What the kernel knows of a connection; round-trip times in s, 0 if it does not know them. */
struct LinkMeasurement {
  double mean = 0;
  /** In the last five minutes. */
  double least = 0;
  /** Packets that were repeated on the connection until now. */
  uint32_t num_repeated_packets = 0;
};
/** Measures it, and bounds the unsent bytes by the measured delivery rate. */
LinkMeasurement measure_link(Tcp::socket& socket);

/** Bytes that were written and that the other end has not acknowledged. */
size_t count_unacknowledged(Tcp::socket& socket);

/** Serves a connection of the raw TCP port until it ends. */
void serve_tcp(ConnectionContext& context, Tcp::socket socket);

/** Serves a connection of the HTTP port until it ends: pages, and WebSockets. */
void serve_http(ConnectionContext& context, Tcp::socket socket);

}  // namespace nao::gateway
