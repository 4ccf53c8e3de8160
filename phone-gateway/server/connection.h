#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "phone-gateway/server/network.h"
#include "phone-gateway/server/turn_queue.h"
#include "phone-gateway/server/waiting_room.h"

namespace nao {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

/** What every connection of the gateway works with. */
struct Hub {
  asio::io_context& io;
  GatewayCore& core;
  WebPages& pages;
  AccessRules rules;
  /** Null without https. */
  std::unique_ptr<asio::ssl::context> tls;
  WaitingRoom waiting_room;
  NetworkCounters counters;
  /** Images for 32 phones take half a millisecond: a state that comes meanwhile shall not wait.
   */
  TurnQueue images;
  /** The network is being taken down: connections end without a word. */
  bool is_ending = false;
};

/** A connection that had not said Connect was closed, for one more came from this address. */
void note_eviction(Hub& hub, const std::string& address);

/** The other end of a socket. */
Peer make_peer(const Tcp::socket& socket, const std::string& transport);

/** Sets up an accepted socket: no delay, and little room for what has not been sent, so that a slow
 * client's next image is chosen late. */
void prepare_socket(Tcp::socket& socket);

/** The system's estimate of the time to the other end and back, s; 0 if it has none. */
double measure_round_trip(Tcp::socket& socket);

/** Serves a connection of the raw TCP port until it ends. */
void serve_tcp(Hub& hub, Tcp::socket socket);

/** Serves a connection of the HTTP port until it ends: pages, and WebSockets. */
void serve_http(Hub& hub, Tcp::socket socket);

}  // namespace nao
