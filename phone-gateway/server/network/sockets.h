#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "phone-gateway/server/core/endpoint.h"

namespace nao::gateway {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

/** TLS of a server. @return Null without a certificate.
 * @throws Error  naming the file that cannot be used. */
std::unique_ptr<asio::ssl::context> load_tls(const std::string& certificate_file,
                                             const std::string& key_file);

/** The other end of a socket. */
Endpoint make_endpoint(const Tcp::socket& socket, const std::string& transport);

/** Sets the options of an accepted socket: no waiting in send_now(), no delay, a small limit of
 * unsent bytes, so that the next image of a slow client is chosen late, and the congestion control
 * (NetworkOptions). */
void prepare_socket(Tcp::socket& socket, const std::string& congestion_control);

/** What the kernel knows of a connection; round-trip times in s, 0 if it does not know them. */
struct LinkMeasurement {
  double mean = 0;
  /** In the last five minutes. */
  double least = 0;
  /** Packets that were repeated on the connection until now. */
  uint32_t num_repeated_packets = 0;
  /** Bytes of a packet; 0: not known. */
  uint32_t segment_bytes = 0;
};
/** Measures it, and bounds the unsent bytes by the measured delivery rate. */
LinkMeasurement measure_link(Tcp::socket& socket);

/** Bytes that were written and that the other end has not acknowledged.
 * @param segment_bytes  Of its LinkMeasurement. */
size_t count_unacknowledged(Tcp::socket& socket, uint32_t segment_bytes);

/** Sends what the socket takes at once. @return Number of bytes; also 0 if the connection has
 * failed, which the next operation reports. */
template <class Buffers>
size_t send_now(Tcp::socket& socket, const Buffers& buffers) {
  boost::system::error_code error;
  const size_t size = socket.send(buffers, 0, error);
  return error ? 0 : size;
}

}  // namespace nao::gateway
