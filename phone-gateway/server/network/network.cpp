#include "phone-gateway/server/network/bluetooth_server.h"
#include "phone-gateway/server/network/client_connection.h"
#include "phone-gateway/server/network/connection_context.h"
#include "phone-gateway/server/network/relay_client.h"
#include "phone-gateway/server/network/websocket_connection.h"
//
#include <chrono>
#include <utility>

#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/listen.h"

namespace nao::gateway {
namespace {

/** See PROTOCOL.md. Chosen: four times the clients that may connect, well below the usual limit of
 * 1024 file descriptors. */
constexpr size_t kMaxHandshakes = 128;
/** Times after which other events are handled. Chosen: a message to a phone takes about 6 us, so
 * that one iteration serves 100 phones, and a state waits for at most ten images. */
constexpr std::chrono::microseconds kFlushSlice{1000};
constexpr std::chrono::microseconds kImageSlice{50};
/** Period, s, of looking for invitations that have ended. */
constexpr double kInvitationPeriod = 0.5;

}  // namespace

struct Network::Impl {
  Impl(std::unique_ptr<AsioLoop> new_loop, const NetworkOptions& options, AccessRules rules,
       GatewayCore& core, WebPages& pages)
      : context{HttpContext{new_loop->io(),
                            "nao-phone-gateway",
                            pages,
                            std::move(rules),
                            load_tls(options.certificate_file, options.key_file),
                            HandshakeLimiter(kMaxHandshakes),
                            {},
                            [&core](const std::string& address, const std::string& why) {
                              core.note_refusal(address, why);
                            },
                            [this](WebStream stream, WebRequest request) {
                              serve_websocket(context, std::move(stream), std::move(request));
                            }},
                core,
                {new_loop->io(), kFlushSlice,
                 [](const std::weak_ptr<ClientConnection>& connection) {
                   if (const auto queued = connection.lock()) queued->flush();
                 }},
                {new_loop->io(), kImageSlice,
                 [](const std::weak_ptr<ClientConnection>& connection) {
                   if (const auto queued = connection.lock()) queued->send_long();
                 }},
                false},
        loop(std::move(new_loop)),
        http(loop->io(), options.bind, options.http_port, "--http-port",
             accepting([this](Tcp::socket socket) { serve_http(context, std::move(socket)); })),
        tcp(loop->io(), options.bind, options.tcp_port, "--tcp-port",
            accepting([this](Tcp::socket socket) { serve_tcp(context, std::move(socket)); })),
        congestion_control(options.congestion_control) {
    if (!options.bluetooth_name.empty()) {
      bluetooth = std::make_unique<BluetoothServer>(context, options.bluetooth_name);
    }
    if (options.relay.empty()) return;
    relay = std::make_unique<RelayClient>(context, options.relay, options.relay_file);
    loop->every(kInvitationPeriod, [this] {
      if (relay) relay->step();
    });
  }

  std::function<void(Tcp::socket)> accepting(std::function<void(Tcp::socket)> serve) {
    return [this, serve = std::move(serve)](Tcp::socket socket) {
      ++context.counters.num_accepted;
      if (on_accepted) on_accepted();
      prepare_socket(socket, congestion_control);
      serve(std::move(socket));
    };
  }

  // Before `loop`, which destroys the connections: they use the context until then.
  ConnectionContext context;
  std::unique_ptr<AsioLoop> loop;
  TcpListener http;
  TcpListener tcp;
  std::function<void()> on_accepted;
  std::string congestion_control;
  std::unique_ptr<RelayClient> relay;
  std::unique_ptr<BluetoothServer> bluetooth;
};

Network::Network(const NetworkOptions& options, AccessRules rules, GatewayCore& core,
                 WebPages& pages)
    : impl_(std::make_unique<Impl>(std::make_unique<AsioLoop>(), options, std::move(rules), core,
                                   pages)) {}

Network::~Network() {
  impl_->relay.reset();
  impl_->bluetooth.reset();
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
  impl_->relay.reset();
  impl_->loop->run_for(time);
}

}  // namespace nao::gateway
