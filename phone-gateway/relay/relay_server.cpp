#include "phone-gateway/relay/relay_server.h"

#include "phone-gateway/relay/robot_connection.h"
#include "phone-gateway/relay/splice.h"

#include "phone-gateway/server/network/http_server.h"
//
#include <openssl/ssl.h>

#include <map>
#include <utility>

#include "common/data_path.h"
#include "common/logger.h"
#include "common/rate_limiter.h"
#include "common/wall_clock.h"
#include "phone-gateway/secure_channel/hexadecimal.h"
#include "phone-gateway/secure_channel/relay_target.h"
#include "phone-gateway/server/core/prometheus_text.h"
#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/listen.h"

namespace nao::relay {
namespace {

/** Connections that have asked for nothing yet. Chosen: half of the phones come back at once. */
constexpr size_t kMaxHandshakes = 512;
/** Period, s, of looking for phones whose gateway does not come. */
constexpr double kStepPeriod = 0.5;

/** Accepts a WebSocket only to say why it is closed: a browser shows its page no HTTP status. */
void refuse(WebStream stream, WebRequest request, const std::string& why) {
  struct Refusal {
    WebSocket socket;
    WebRequest request;
  };
  const auto refusal =
      std::make_shared<Refusal>(Refusal{WebSocket(std::move(stream)), std::move(request)});
  prepare(refusal->socket, kHandshakeTimeout, false);
  refusal->socket.async_accept(refusal->request, [refusal, why](const error_code& error) {
    if (error) return;
    refusal->socket.async_close({websocket::close_code::policy_error, why.c_str()},
                                [refusal](const error_code&) {});
  });
}

}  // namespace

struct RelayServer::Impl {
  Impl(std::unique_ptr<AsioLoop> new_loop, const RelayOptions& options)
      : core(options.limits, [] { return to_hex(random_bytes(kTicketBytes)); }),
        pages(data_path()),
        context{new_loop->io(),
                "nao-relay",
                pages,
                std::nullopt,
                gateway::load_tls(options.certificate_file, options.key_file),
                gateway::HandshakeLimiter(kMaxHandshakes),
                {},
                [this](const std::string& address, const std::string& why) {
                  note_refusal(address, why);
                },
                [this](WebStream stream, WebRequest request) {
                  serve(std::move(stream), std::move(request));
                },
                true},
        loop(std::move(new_loop)),
        listener(loop->io(), options.bind, options.port, "--port",
                 [this](gateway::Tcp::socket socket) {
                   gateway::prepare_socket(socket, "");
                   gateway::serve_http(context, std::move(socket));
                 }) {
    // No sessions are kept, which would serve phones for one handshake.
    SSL_CTX_set_session_cache_mode(context.tls->native_handle(), SSL_SESS_CACHE_OFF);
    SSL_CTX_set_num_tickets(context.tls->native_handle(), 0);
    // What is relayed is encrypted from end to end. The post-quantum key that OpenSSL 3.5 would
    // agree on stays in memory: 6 kB a connection, measured with 1000 phones.
    SSL_CTX_set1_groups_list(context.tls->native_handle(), "X25519:P-256");
    loop->every(kStepPeriod, [this] { close_late_phones(); });
    pages.add_page("/metrics", {"text/plain; charset=utf-8", true, [this] { return metrics(); }});
  }

  void note_refusal(const std::string& address, const std::string& why) {
    if (log_rate.allow(monotonic_seconds())) logger::info("{} refused: {}", address, why);
  }

  void serve(WebStream stream, WebRequest request) {
    const std::string address = gateway::make_endpoint(stream.next_layer().socket(), "").address;
    const auto target = parse_relay_target({request.target().data(), request.target().size()});
    if (!target)
      return refuse_with(std::move(stream), std::move(request), address,
                         "This is no address of a robot: open the invitation's link.");
    // A ticket is good once, and what comes over its connection is encrypted.
    if (!stream.is_secure() && target->kind != RelayTarget::Kind::kTicket) {
      return refuse_with(std::move(stream), std::move(request), address,
                         "This server speaks https.");
    }
    switch (target->kind) {
      case RelayTarget::Kind::kPhone:
        return serve_phone(std::move(stream), std::move(request), target->value, address);
      case RelayTarget::Kind::kRobot:
        return serve_robot(std::move(stream), std::move(request), robot_of_key(target->value),
                           address);
      case RelayTarget::Kind::kTicket:
        return serve_ticket(std::move(stream), std::move(request), target->value, address);
    }
  }

  void refuse_with(WebStream stream, WebRequest request, const std::string& address,
                   const std::string& why) {
    note_refusal(address, why);
    refuse(std::move(stream), std::move(request), why);
  }

  void serve_phone(WebStream stream, WebRequest request, const std::string& robot,
                   const std::string& address) {
    const auto added = core.add_phone(robot, address, monotonic_seconds());
    if (const auto* why = std::get_if<RelayCore::Refused>(&added)) {
      return refuse_with(std::move(stream), std::move(request), address, *why);
    }
    const auto& waiting = std::get<RelayCore::Waiting>(added);
    const auto splice = std::make_shared<Splice>(
        std::move(stream), [this, waiting] { core.remove_phone(waiting.phone); });
    splice->accept_phone(std::move(request), [this, robot, waiting] {
      const auto found = robots.find(core.robot_connection(robot));
      const auto connection = found == robots.end() ? nullptr : found->second.lock();
      if (connection) connection->send(waiting.ticket);
    });
    // It waits for its gateway without an operation of its own.
    waiting_splices[waiting.phone] = splice;
  }

  void serve_ticket(WebStream stream, WebRequest request, const std::string& ticket,
                    const std::string& address) {
    const uint32_t phone = core.take_ticket(ticket);
    const auto found = waiting_splices.find(phone);
    if (found == waiting_splices.end()) {
      return refuse_with(std::move(stream), std::move(request), address,
                         "No phone waits with this ticket.");
    }
    const auto splice = std::move(found->second);
    waiting_splices.erase(found);
    splice->accept_gateway(std::move(stream), std::move(request));
  }

  void serve_robot(WebStream stream, WebRequest request, const std::string& robot,
                   const std::string& address) {
    const uint32_t before = core.robot_connection(robot);
    const auto added = core.add_robot(robot, address);
    if (const auto* why = std::get_if<RelayCore::Refused>(&added)) {
      return refuse_with(std::move(stream), std::move(request), address, *why);
    }
    const uint32_t number = std::get<uint32_t>(added);
    if (const auto old = robots.find(before); old != robots.end()) {
      if (const auto connection = old->second.lock()) connection->close();
    }
    const auto connection =
        std::make_shared<RobotConnection>(std::move(stream), [this, robot, number] {
          core.remove_robot(robot, number);
          robots.erase(number);
          logger::info("robot {} left", robot);
        });
    robots[number] = connection;
    connection->start(std::move(request));
    logger::info("robot {} from {}", robot, address);
  }

  void close_late_phones() {
    for (const uint32_t phone : core.late_phones(monotonic_seconds())) {
      const auto splice = std::move(waiting_splices[phone]);
      waiting_splices.erase(phone);
      if (splice) splice->close();
    }
  }

  std::string metrics() const {
    gateway::PrometheusText text("nao_relay_");
    const auto add = [&text](const char* name, double value, const char* help) {
      text.begin(name, help);
      text.add(value);
    };
    add("phones", static_cast<double>(core.num_phones()), "Phones connected");
    add("robots", static_cast<double>(core.num_robots()), "Robots connected");
    add("evicted_total", static_cast<double>(context.counters.num_evicted),
        "Connections evicted by the handshake limiter");
    add("violations_total", static_cast<double>(context.counters.num_violations),
        "Connections that violated HTTP");
    return text.text();
  }

  RelayCore core;
  gateway::WebPages pages;
  gateway::HttpContext context;
  std::map<uint32_t, std::shared_ptr<Splice>> waiting_splices;
  std::map<uint32_t, std::weak_ptr<RobotConnection>> robots;
  RateLimiter log_rate{1.0};
  // After what the connections use: it destroys them.
  std::unique_ptr<AsioLoop> loop;
  TcpListener listener;
};

RelayServer::RelayServer(const RelayOptions& options)
    : impl_(std::make_unique<Impl>(std::make_unique<AsioLoop>(), options)) {}

RelayServer::~RelayServer() = default;

uint16_t RelayServer::port() const {
  return impl_->listener.port();
}

AsioLoop& RelayServer::loop() {
  return *impl_->loop;
}

}  // namespace nao::relay
