#include "tools/bench/gateway_streams.h"

#include "common/wall_clock.h"
#include "tools/bench/bare_sender_cost.h"
#include "tools/bench/disturbing_clients.h"

namespace nao::bench {
namespace {

/** Chosen: a classroom; nao-bench-crowd measures 100 clients of several robots. */
constexpr int kNumClients = 32;

/** Messages that the clients received over some seconds. */
struct Watching {
  std::vector<double> state_age_ms;
  std::vector<double> image_age_ms;
  double num_states = 0;
  double num_images = 0;
  double state_bytes = 0;
  double image_bytes = 0;
  double cpu_percent = 0;
  double rss_mib = 0;
};

/** Lets clients watch, half of them over WebSocket. An age is the time from a state on the bus to
 * its arrival here. */
Watching watch(GatewayStack& stack, int num_clients, double state_rate, double image_rate,
               double time) {
  std::vector<std::unique_ptr<WireClient>> clients;
  Watching seen;
  for (int i = 0; i < num_clients; ++i) {
    clients.push_back(i % 2 == 0 ? connect_tcp(stack.tcp_port())
                                 : connect_websocket(stack.http_port()));
    clients.back()->send(connect_request("bench " + std::to_string(i)));
    naoremote::Request request;
    request.mutable_subscribe()->set_state_rate(state_rate);
    request.mutable_subscribe()->set_image_rate(image_rate);
    clients.back()->send(request);
    stack.watch(clients.back().get(), [&](const naoremote::ServerMessage& message, double now) {
      if (message.has_state()) {
        if (const auto then = stack.time_of_state(message.state().utime())) {
          seen.state_age_ms.push_back((now - *then) * 1e3);
        }
        ++seen.num_states;
        seen.state_bytes += static_cast<double>(message.ByteSizeLong());
      } else if (message.has_image()) {
        if (const auto then = stack.time_of_state(message.image().utime())) {
          seen.image_age_ms.push_back((now - *then) * 1e3);
        }
        ++seen.num_images;
        seen.image_bytes += static_cast<double>(message.ByteSizeLong());
      }
    });
  }
  const auto run_alive = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(seconds); ++i) {
      naoremote::Request ping;
      ping.mutable_ping();
      for (const auto& client : clients) client->send(ping);
      stack.run_for(1);
    }
  };
  run_alive(2);
  seen = {};
  const double cpu_before = stack.gateway().cpu_seconds();
  const double start = monotonic_seconds();
  run_alive(time);
  const double elapsed = monotonic_seconds() - start;
  seen.cpu_percent = (stack.gateway().cpu_seconds() - cpu_before) / elapsed * 100;
  seen.rss_mib = stack.gateway().rss_mib();
  stack.forget_clients();
  return seen;
}

/** Data that each client received, which the baseline must send. */
SentTraffic traffic_of(const Watching& seen, double state_rate, double image_rate) {
  // Each message is preceded by its size.
  constexpr double kFrameBytes = 4;
  const auto mean = [](double sum, double number) { return number > 0 ? sum / number : 0; };
  return {.state_rate = state_rate,
          .image_rate = image_rate,
          .state_bytes = mean(seen.state_bytes, seen.num_states) + kFrameBytes,
          .image_bytes = mean(seen.image_bytes, seen.num_images) + kFrameBytes};
}

/** What many clients cost, and the age of their states. @param one  One client. */
Watching measure_clients(GatewayStack& stack, int num_clients, const std::string& name,
                         const Watching& one, double time, std::vector<Figure>& figures) {
  const std::string prefix = "gateway." + name;
  Watching many = watch(stack, num_clients, 30, 15, time);
  const SentTraffic traffic = traffic_of(many, 30, 15);
  figures.push_back({prefix + "_cpu_percent", many.cpu_percent, "%", "bare Asio loop",
                     measure_bare_sender(traffic, num_clients, time)});
  for (const auto& [share, word] : {std::pair{0.5, "p50"}, {0.9, "p90"}, {0.99, "p99"}}) {
    figures.push_back({prefix + "_state_age_ms." + word, percentile(many.state_age_ms, share), "ms",
                       "one client", percentile(one.state_age_ms, share)});
  }
  figures.push_back(
      {prefix + "_rate_hz", many.num_states / time / num_clients, "1/s", "asked for", 30});
  figures.push_back({prefix + "_rss_mib", many.rss_mib, "MiB", "one client", one.rss_mib});
  return many;
}

}  // namespace

void measure_streams(GatewayStack& stack, double time, std::vector<Figure>& figures) {
  const Watching one = watch(stack, 1, 60, 30, time);
  figures.push_back({"gateway.state_age_ms.p99", percentile(one.state_age_ms, 0.99), "ms", "", 0});
  figures.push_back({"gateway.image_age_ms.p95", percentile(one.image_age_ms, 0.95), "ms", "", 0});
  figures.push_back({"gateway.state_rate_hz", one.num_states / time, "1/s", "asked for", 60});
  figures.push_back({"gateway.image_rate_hz", one.num_images / time, "1/s", "asked for", 30});

  const Watching few = watch(stack, 1, 30, 15, time);
  const Watching many = measure_clients(stack, kNumClients, "clients32", few, time, figures);
  measure_clients(stack, 100, "clients100_of_one_robot", few, time, figures);

  const DisturbingClients disturbing(stack.tcp_port());
  const Watching disturbed = watch(stack, kNumClients - 3, 30, 15, time);
  const double good_clients = kNumClients - 3;
  figures.push_back({"gateway.disturbed_cpu_percent", disturbed.cpu_percent, "%", "undisturbed",
                     many.cpu_percent});
  figures.push_back({"gateway.disturbed_state_age_ms.p99", percentile(disturbed.state_age_ms, 0.99),
                     "ms", "undisturbed", percentile(many.state_age_ms, 0.99)});
  figures.push_back({"gateway.disturbed_image_age_ms.p95", percentile(disturbed.image_age_ms, 0.95),
                     "ms", "undisturbed", percentile(many.image_age_ms, 0.95)});
  figures.push_back({"gateway.disturbed_rate_hz", disturbed.num_states / time / good_clients, "1/s",
                     "undisturbed", many.num_states / time / kNumClients});
  figures.push_back(
      {"gateway.disturbed_rss_mib", disturbed.rss_mib, "MiB", "undisturbed", many.rss_mib});
}

}  // namespace nao::bench
