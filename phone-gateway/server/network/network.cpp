#include "phone-gateway/server/network/connection_context.h"
//
#include <linux/sockios.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>

#include "common/error.h"
#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/listen.h"

namespace nao::gateway {
namespace {

using boost::system::error_code;

/** See PROTOCOL.md. Chosen: four times the clients that may connect, well below the usual limit of
 * 1024 file descriptors. */
constexpr size_t kMaxHandshakes = 128;
/** Bytes that the kernel holds unsent before it stops accepting more: two images of 320 x 240
 * pixels (7 kB each), so that the next image is chosen late, but the connection always has data. */
constexpr int kMaxUnsentBytes = 16384;
/** Bytes of a segment on Ethernet and Wi-Fi, at most. */
constexpr int kEthernetSegment = 1460;

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

void prepare_socket(Tcp::socket& socket) {
  error_code ignored;
  // Commands and states are small and must not wait (Nagle's algorithm).
  socket.set_option(Tcp::no_delay(true), ignored);
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kMaxUnsentBytes,
             sizeof kMaxUnsentBytes);
}

double measure_round_trip_time(Tcp::socket& socket) {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (getsockopt(socket.native_handle(), IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
  // Microseconds, the kernel's smoothed estimate.
  return info.tcpi_rtt * 1e-6;
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
        tcp(loop->io(), options.bind, options.tcp_port, "--tcp-port", accepting(serve_tcp)) {}

  std::function<void(Tcp::socket)> accepting(void (*serve)(ConnectionContext&, Tcp::socket)) {
    return [this, serve](Tcp::socket socket) {
      ++context.counters.num_accepted;
      if (on_accepted) on_accepted();
      prepare_socket(socket);
      serve(context, std::move(socket));
    };
  }

  // Before `loop`, which destroys the connections: they use the context until then.
  ConnectionContext context;
  std::unique_ptr<AsioLoop> loop;
  TcpListener http;
  TcpListener tcp;
  std::function<void()> on_accepted;
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
