// Measures what nao-foxglove costs with clients that subscribe to every channel at its full rate,
// in real time. Baseline: a bare loop that sends as many bytes as often to as many connections.

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/child_process.h"
#include "common/json_text.h"
#include "common/wall_clock.h"
#include "tools/bench/bare_sender_cost.h"
#include "tools/bench/deadline.h"
#include "tools/bench/ports.h"
#include "tools/bench/run_benchmark.h"
#include "tools/bench/websocket_client.h"

namespace nao::bench {
namespace {

// Chosen: more than one developer at a time.
constexpr int kNumClients = 3;
// Time in which clients catch up with waiting messages, s. Chosen: some MB take milliseconds.
constexpr double kCatchUp = 2;
// Size from which a message counts as an image, bytes.
constexpr size_t kImageBytes = 16384;
// Limit of a client; above every message of the bus.
constexpr size_t kMaxMessageBytes = 64u << 20;
// Opcode, subscription and time of the protocol's "message data".
constexpr size_t kMessageHeadBytes = 1 + 4 + 8;

/** Messages of a kind that were received. */
struct Received {
  double num = 0;
  double bytes = 0;
};

/** A client that subscribes to every channel and reads. */
class Subscriber {
 public:
  explicit Subscriber(uint16_t port)
      : socket_({.port = port,
                 .subprotocol = "foxglove.sdk.v1",
                 .max_message_bytes = kMaxMessageBytes}) {}

  void read() {
    socket_.read();
    for (const WebSocketClient::Message& message : socket_.take_messages()) {
      if (message.is_text) {
        subscribe(parse_json(message.bytes));
      } else {
        count(message.bytes);
      }
    }
  }

  int descriptor() const { return socket_.descriptor(); }

  Received states;
  Received images;
  /** Messages by topic. */
  std::map<std::string, double> topics;

 private:
  /** A message: opcode, subscription (32 bits, the lowest byte first), time, data. */
  void count(const std::string& message) {
    if (message.size() <= kMessageHeadBytes) return;
    Received& received = message.size() < kImageBytes ? states : images;
    received.num += 1;
    received.bytes += static_cast<double>(message.size());
    const auto byte = [&](size_t index) { return static_cast<uint8_t>(message[index]); };
    topics[topics_[byte(1) | byte(2) << 8]] += 1;
  }

  void subscribe(const nlohmann::json& message) {
    if (message["op"] != "advertise") return;
    nlohmann::json request{{"op", "subscribe"}, {"subscriptions", nlohmann::json::array()}};
    for (const auto& channel : message["channels"]) {
      topics_[channel["id"]] = channel["topic"];
      request["subscriptions"].push_back({{"id", channel["id"]}, {"channelId", channel["id"]}});
    }
    socket_.send_text(request.dump());
  }

  WebSocketClient socket_;
  std::map<int, std::string> topics_;
};

/** Reads from all clients for a time, s. */
void read_for(std::list<Subscriber>& clients, double time) {
  std::vector<pollfd> polled;
  for (const Subscriber& client : clients) polled.push_back({client.descriptor(), POLLIN, 0});
  const double end = monotonic_seconds() + time;
  while (monotonic_seconds() < end) {
    poll(polled.data(), polled.size(), 10);
    for (Subscriber& client : clients) client.read();
  }
}

SentTraffic traffic_of(const Subscriber& seen, double time) {
  const auto mean = [](const Received& received) {
    return received.num > 0 ? received.bytes / received.num : 0;
  };
  return {.state_rate = seen.states.num / time,
          .image_rate = seen.images.num / time,
          .state_bytes = mean(seen.states),
          .image_bytes = mean(seen.images)};
}

/** One pair of measurements. */
void measure(std::list<Subscriber>& clients, const ChildProcess& server, double time,
             std::vector<double>& server_percent, std::vector<double>& bare_percent) {
  // First read the messages that waited while the clients did not read.
  read_for(clients, kCatchUp);
  for (Subscriber& client : clients) {
    client.states = client.images = {};
    client.topics.clear();
  }
  const double cpu_before = server.cpu_seconds();
  const double start = monotonic_seconds();
  read_for(clients, time);
  server_percent.push_back((server.cpu_seconds() - cpu_before) / (monotonic_seconds() - start) *
                           100);
  bare_percent.push_back(measure_bare_sender(traffic_of(clients.front(), time), kNumClients, time));
}

std::vector<Figure> run(int num_rounds, double time, bool prints_topics) {
  const std::string lcm_url =
      "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
  std::map<std::string, std::unique_ptr<ChildProcess>> programs;
  const auto start = [&](const std::string& name, std::vector<std::string> options) {
    std::vector<std::string> command{program_folder() + "/" + name, "--lcm-url", lcm_url};
    command.insert(command.end(), options.begin(), options.end());
    programs[name] = std::make_unique<ChildProcess>(command);
  };
  start("nao-sim", {});
  start("nao-motion", {});
  start("nao-head-camera", {});
  start("nao-foxglove", {"--port", "0"});
  const ChildProcess& server = *programs.at("nao-foxglove");
  const uint16_t port = wait_for_port(server, "ws://");

  const double idle_before = server.cpu_seconds();
  std::this_thread::sleep_for(std::chrono::duration<double>(time));
  const double idle = (server.cpu_seconds() - idle_before) / time * 100;

  std::list<Subscriber> clients;
  for (int i = 0; i < kNumClients; ++i) clients.emplace_back(port);
  // All channels have appeared, and images arrive.
  const double deadline = monotonic_seconds() + kDeadline;
  while (clients.front().topics["/NAO/camera/top/image"] < 10) {
    if (monotonic_seconds() > deadline) throw std::runtime_error("no images come");
    read_for(clients, 0.1);
  }
  std::vector<double> server_percent;
  std::vector<double> bare_percent;
  for (int i = 0; i < num_rounds; ++i) {
    measure(clients, server, time, server_percent, bare_percent);
  }
  const Subscriber& seen = clients.front();
  if (prints_topics) {
    for (const auto& [topic, num] : seen.topics) {
      std::fprintf(stderr, "%-32s %6.1f/s\n", topic.c_str(), num / time);
    }
  }
  return {
      {"foxglove.clients3_cpu_percent", median(server_percent), "%", "bare Asio loop",
       median(bare_percent)},
      {"foxglove.idle_cpu_percent", idle, "%", "", 0},
      {"foxglove.messages_per_s", (seen.states.num + seen.images.num) / time, "1/s", "", 0},
      {"foxglove.mb_per_s", (seen.states.bytes + seen.images.bytes) / time * 1e-6, "MB/s", "", 0},
      {"foxglove.rss_mib", server.rss_mib(), "MiB", "", 0}};
}

}  // namespace
}  // namespace nao::bench

int main(int argc, char** argv) {
  nao::CommandLine app("Measures nao-foxglove with three clients of every channel",
                       "nao-bench-foxglove");
  int num_rounds = 5;
  double time = 10;
  bool prints_topics = false;
  app.add_option("--rounds", num_rounds, "Pairs of measurements; the medians count")
      ->range(1, 1000);
  app.add_option("--time", time, "Duration of each measurement, s")->range(1.0, 3600.0);
  app.add_flag("--topics", prints_topics, "Also print the rate of every channel");
  return nao::run_benchmark(app, argc, argv,
                            [&] { return nao::bench::run(num_rounds, time, prints_topics); });
}
