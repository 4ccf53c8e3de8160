#include "phone-gateway/server/network/connection_context.h"
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
#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/listen.h"

namespace nao::gateway {
namespace {

using boost::system::error_code;

/** See PROTOCOL.md. Chosen: four times the clients that may connect, well below the usual limit of
 * 1024 file descriptors. */
constexpr size_t kMaxHandshakes = 128;
/** Bytes that the kernel holds unsent before it stops accepting more: what the link delivers in
 * this time, s, so that the next state is chosen late; at least three states, at most two images of
 * 320 x 240 pixels (7 kB each). */
constexpr double kMaxUnsentTime = 0.03;
constexpr int kLeastUnsentBytes = 1024;
constexpr int kMaxUnsentBytes = 16384;
/** Bytes of a segment on Ethernet and Wi-Fi, at most. */
constexpr int kEthernetSegment = 1460;

/** tcp_info of linux/tcp.h, which excludes netinet/tcp.h, as far as it is used. */
struct LinuxTcpInfo {
  std::array<uint32_t, 17> before_rtt;
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

std::unique_ptr<asio::ssl::context> load_tls(const NetworkOptions& options) {
  if (options.certificate_file.empty()) return nullptr;
  auto tls = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
  // TLS 1.2 at least (RFC 8996 deprecates 1.0 and 1.1).
  tls->set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_sslv2 |
                   asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                   asio::ssl::context::no_tlsv1_1);
  error_code error;
  tls->use_certificate_chain_file(options.certificate_file, error);
  if (error) {
    throw Error("cannot use the certificate " + options.certificate_file + ": " + error.message());
  }
  tls->use_private_key_file(options.key_file, asio::ssl::context::pem, error);
  if (error) throw Error("cannot use the key " + options.key_file + ": " + error.message());
  return tls;
}

/** The address itself; for an IPv4 client on an IPv6 socket its IPv4 address. */
asio::ip::address plain_address(const asio::ip::address& address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
  }
  return address;
}

}  // namespace

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

void note_eviction(ConnectionContext& context, const std::string& address) {
  ++context.counters.num_evicted;
  context.core.note_refusal(address, "Too many connections without Connect.");
}

void prepare_socket(Tcp::socket& socket, const std::string& congestion_control) {
  error_code ignored;
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
  return {info.rtt * 1e-6, info.min_rtt == UINT32_MAX ? 0 : info.min_rtt * 1e-6, info.after_rtt[7]};
}

size_t count_unacknowledged(Tcp::socket& socket) {
  int bytes = 0;
  if (ioctl(socket.native_handle(), SIOCOUTQ, &bytes) != 0) return 0;
  // The other end may keep the acknowledgement of two segments back for a while, which counts where
  // they are as large as on the loopback interface.
  int segment = 0;
  socklen_t size = sizeof segment;
  const auto descriptor = socket.native_handle();
  if (getsockopt(descriptor, IPPROTO_TCP, TCP_MAXSEG, &segment, &size) == 0 &&
      segment > kEthernetSegment) {
    bytes -= 2 * segment;
  }
  return static_cast<size_t>(std::max(bytes, 0));
}

struct Network::Impl {
  Impl(std::unique_ptr<AsioLoop> new_loop, const NetworkOptions& options, AccessRules rules,
       GatewayCore& core, WebPages& pages)
      : context{new_loop->io(),
                core,
                pages,
                std::move(rules),
                load_tls(options),
                HandshakeLimiter(kMaxHandshakes),
                {},
                FairQueue(new_loop->io()),
                false},
        loop(std::move(new_loop)),
        http(loop->io(), options.bind, options.http_port, "--http-port", accepting(serve_http)),
        tcp(loop->io(), options.bind, options.tcp_port, "--tcp-port", accepting(serve_tcp)),
        congestion_control(options.congestion_control) {}

  std::function<void(Tcp::socket)> accepting(void (*serve)(ConnectionContext&, Tcp::socket)) {
    return [this, serve](Tcp::socket socket) {
      ++context.counters.num_accepted;
      if (on_accepted) on_accepted();
      prepare_socket(socket, congestion_control);
      serve(context, std::move(socket));
    };
  }

  // Before `loop`, which destroys the connections: they use the context until then.
  ConnectionContext context;
  std::unique_ptr<AsioLoop> loop;
  TcpListener http;
  TcpListener tcp;
  std::function<void()> on_accepted;
  std::string congestion_control;
};

Network::Network(const NetworkOptions& options, AccessRules rules, GatewayCore& core,
                 WebPages& pages)
    : impl_(std::make_unique<Impl>(std::make_unique<AsioLoop>(), options, std::move(rules), core,
                                   pages)) {}

Network::~Network() {
  impl_->context.is_shutting_down = true;
}

void Network::on_accepted(std::function<void()> handler) {
  impl_->on_accepted = std::move(handler);
}

uint16_t Network::http_port() const {
  return impl_->http.port();
}

uint16_t Network::tcp_port() const {
  return impl_->tcp.port();
}

const NetworkCounters& Network::counters() const {
  return impl_->context.counters;
}

std::vector<Metric> Network::metrics() const {
  const NetworkCounters& counters = impl_->context.counters;
  const auto metric = [](const char* name, int64_t value, const char* help) {
    return Metric{name, static_cast<double>(value), help};
  };
  return {
      metric("accepted_total", counters.num_accepted, "Connections accepted"),
      metric("http_requests_total", counters.num_http_requests, "HTTP requests"),
      metric("refused_hosts_total", counters.num_refused_hosts,
             "HTTP requests with an unknown Host"),
      metric("refused_origins_total", counters.num_refused_origins,
             "WebSockets refused because of their Origin"),
      metric("evicted_total", counters.num_evicted, "Connections evicted by the handshake limiter"),
      metric("violations_total", counters.num_violations,
             "Connections that violated HTTP, WebSocket or framing")};
}

AsioLoop& Network::loop() {
  return *impl_->loop;
}

// Connections are closed by the core; this gives them time to send their last messages.
void Network::drain(double time) {
  impl_->http.close();
  impl_->tcp.close();
  impl_->loop->run_for(time);
}

}  // namespace nao::gateway
