#include "phone-gateway/server/network/sockets.h"
//
#include <linux/sockios.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/error.h"

namespace nao::gateway {
namespace {

using boost::system::error_code;

/** Bytes that the kernel holds unsent before it stops accepting more: what the link delivers in
 * this time, s, so that the next state is chosen late; at least three states, at most two images of
 * 320 x 240 pixels (7 kB each). */
constexpr double kMaxUnsentTime = 0.03;
constexpr int kLeastUnsentBytes = 1024;
constexpr int kMaxUnsentBytes = 16384;
/** Bytes of a segment on Ethernet and Wi-Fi, at most. */
constexpr uint32_t kEthernetSegment = 1460;

/** tcp_info of linux/tcp.h, which excludes netinet/tcp.h, as far as it is used. */
struct LinuxTcpInfo {
  std::array<uint32_t, 4> before_segment;
  /** Bytes of a packet that is sent. */
  uint32_t segment;
  std::array<uint32_t, 12> before_rtt;
  /** Microseconds, smoothed. */
  uint32_t rtt;
  /** The last one: packets repeated until now. */
  std::array<uint32_t, 8> after_rtt;
  std::array<uint64_t, 4> pacing_and_bytes;
  std::array<uint32_t, 3> segments;
  /** Microseconds, in the last five minutes. */
  uint32_t min_rtt;
  std::array<uint32_t, 2> data_segments;
  /** Bytes a second. */
  uint64_t delivery_rate;
};
static_assert(offsetof(LinuxTcpInfo, delivery_rate) == 160);

/** The address itself; for an IPv4 client on an IPv6 socket its IPv4 address. */
asio::ip::address plain_address(const asio::ip::address& address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
  }
  return address;
}

}  // namespace

std::unique_ptr<asio::ssl::context> load_tls(const std::string& certificate_file,
                                             const std::string& key_file) {
  if (certificate_file.empty()) return nullptr;
  auto tls = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
  // TLS 1.2 at least (RFC 8996 deprecates 1.0 and 1.1).
  tls->set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_sslv2 |
                   asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                   asio::ssl::context::no_tlsv1_1);
  error_code error;
  tls->use_certificate_chain_file(certificate_file, error);
  if (error) {
    throw Error("cannot use the certificate " + certificate_file + ": " + error.message());
  }
  tls->use_private_key_file(key_file, asio::ssl::context::pem, error);
  if (error) throw Error("cannot use the key " + key_file + ": " + error.message());
  return tls;
}

Endpoint make_endpoint(const Tcp::socket& socket, const std::string& transport) {
  error_code remote_error;
  error_code local_error;
  const auto remote = plain_address(socket.remote_endpoint(remote_error).address());
  const auto local = plain_address(socket.local_endpoint(local_error).address());
  Endpoint endpoint;
  endpoint.transport = transport;
  endpoint.address = remote_error ? "unknown" : remote.to_string();
  // A connection from one of the host's own addresses to the same address is local, too.
  endpoint.is_local = !remote_error && !local_error && (remote.is_loopback() || remote == local);
  return endpoint;
}

void prepare_socket(Tcp::socket& socket, const std::string& congestion_control) {
  error_code ignored;
  socket.non_blocking(true, ignored);
  // Commands and states are small and must not wait (Nagle's algorithm).
  socket.set_option(Tcp::no_delay(true), ignored);
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kMaxUnsentBytes,
             sizeof kMaxUnsentBytes);
  // With few packets under way a lost one is repeated every 0.2 s, and not after 0.2, 0.4, 0.8 s.
  const int on = 1;
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_THIN_LINEAR_TIMEOUTS, &on, sizeof on);
  if (congestion_control.empty()) return;
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_CONGESTION, congestion_control.c_str(),
             static_cast<socklen_t>(congestion_control.size()));
}

LinkMeasurement measure_link(Tcp::socket& socket) {
  LinuxTcpInfo info{};
  socklen_t size = sizeof info;
  const auto descriptor = socket.native_handle();
  if (getsockopt(descriptor, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return {};
  const double unsent = kMaxUnsentTime * static_cast<double>(info.delivery_rate);
  const int limit = std::clamp(static_cast<int>(unsent), kLeastUnsentBytes, kMaxUnsentBytes);
  setsockopt(descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &limit, sizeof limit);
  // The greatest number: not known.
  return {info.rtt * 1e-6, info.min_rtt == UINT32_MAX ? 0 : info.min_rtt * 1e-6, info.after_rtt[7],
          info.segment};
}

size_t count_unacknowledged(Tcp::socket& socket, uint32_t segment_bytes) {
  int bytes = 0;
  if (ioctl(socket.native_handle(), SIOCOUTQ, &bytes) != 0) return 0;
  // The other end may keep the acknowledgement of two segments back for a while, which counts where
  // they are as large as on the loopback interface.
  if (segment_bytes > kEthernetSegment) bytes -= 2 * static_cast<int>(segment_bytes);
  return static_cast<size_t>(std::max(bytes, 0));
}

}  // namespace nao::gateway
