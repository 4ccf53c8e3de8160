// Measures what nao-foxglove costs with clients that subscribe to every channel at its full rate,
// in real time. Baseline: a bare loop that sends as many bytes as often to as many connections.
// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/child_process.h"
#include "common/command_line.h"
#include "common/wall_clock.h"
#include "tools/bench/figures.h"
#include "tools/bench/wire_client.h"

namespace nao::bench {
namespace {

namespace asio = boost::asio;
namespace websocket = boost::beast::websocket;
using Tcp = asio::ip::tcp;

constexpr int kNumClients = 3;
// Time in which the programs must be ready, s. Chosen: no measurement, only the end of a benchmark
// that cannot go on.
constexpr double kDeadline = 60;
// Time in which clients catch up with what has waited for them. Chosen: some MB take milliseconds.
constexpr std::chrono::seconds kCatchUp{2};
// Size from which a message counts as an image, bytes.
constexpr size_t kImageBytes = 16384;

/** Messages of a kind that were received. */
struct Received {
  double num = 0;
  double bytes = 0;
};

/** A client that subscribes to every channel and reads. */
class Subscriber {
 public:
  Subscriber(asio::io_context& io, uint16_t port) : socket_(io) {
    socket_.next_layer().connect({asio::ip::address_v4::loopback(), port});
    socket_.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
      request.set(boost::beast::http::field::sec_websocket_protocol, "foxglove.sdk.v1");
    }));
    socket_.read_message_max(64u << 20);
    socket_.handshake("127.0.0.1", "/");
    read();
  }

  Received states;
  Received images;
  /** Messages by topic. */
  std::map<std::string, double> topics;

 private:
  void read() {
    socket_.async_read(buffer_, [this](const boost::system::error_code& error, size_t size) {
      if (error) throw std::runtime_error("nao-foxglove ended: " + error.message());
      const auto* bytes = static_cast<const uint8_t*>(buffer_.data().data());
      if (socket_.got_text()) {
        subscribe(nlohmann::json::parse(bytes, bytes + size));
      } else if (size > 13) {
        Received& received = size < kImageBytes ? states : images;
        received.num += 1;
        received.bytes += static_cast<double>(size);
        topics[topics_[bytes[1] | bytes[2] << 8]] += 1;
      }
      buffer_.consume(size);
      read();
    });
  }

  void subscribe(const nlohmann::json& message) {
    if (message["op"] != "advertise") return;
    nlohmann::json request{{"op", "subscribe"}, {"subscriptions", nlohmann::json::array()}};
    for (const auto& channel : message["channels"]) {
      topics_[channel["id"]] = channel["topic"];
      request["subscriptions"].push_back({{"id", channel["id"]}, {"channelId", channel["id"]}});
    }
    socket_.text(true);
    socket_.write(asio::buffer(request.dump()));
  }

  websocket::stream<Tcp::socket> socket_;
  boost::beast::flat_buffer buffer_;
  std::map<int, std::string> topics_;
};

uint16_t wait_for_port(const ChildProcess& program, const std::string& pattern) {
  std::smatch port;
  std::string output;
  const double deadline = monotonic_seconds() + kDeadline;
  while (!std::regex_search(output, port, std::regex(pattern))) {
    if (monotonic_seconds() > deadline) throw std::runtime_error("no port is open:\n" + output);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    output = program.output();
  }
  return static_cast<uint16_t>(std::stoi(port[1]));
}

/** Processor time of a bare loop that sends the same, percent of a core. */
double measure_bare_sender(const Subscriber& seen, double time) {
  const auto rate = [time](const Received& received) {
    return std::to_string(std::max(0.1, received.num / time));
  };
  const auto bytes = [](const Received& received) {
    return std::to_string(static_cast<int>(received.num > 0 ? received.bytes / received.num : 1));
  };
  const ChildProcess sender({program_folder() + "/nao-bare-sender", rate(seen.states),
                             bytes(seen.states), rate(seen.images), bytes(seen.images)});
  const uint16_t port = wait_for_port(sender, "port (\\d+)");
  std::vector<pollfd> polled;
  for (int i = 0; i < kNumClients; ++i) {
    polled.push_back({connect_to_own_host(port), POLLIN, 0});
  }
  const double cpu_before = sender.cpu_seconds();
  const double start = monotonic_seconds();
  std::vector<char> part(65536);
  while (monotonic_seconds() < start + time) {
    poll(polled.data(), polled.size(), 100);
    for (const pollfd& one : polled) {
      if (one.revents != 0 && recv(one.fd, part.data(), part.size(), 0) <= 0) {
        throw std::runtime_error("the bare sender ended");
      }
    }
  }
  const double percent = (sender.cpu_seconds() - cpu_before) / (monotonic_seconds() - start) * 100;
  for (const pollfd& one : polled) close(one.fd);
  return percent;
}

/** One pair of measurements. */
void measure(asio::io_context& io, std::list<Subscriber>& clients, const ChildProcess& server,
             double time, std::vector<double>& server_percent, std::vector<double>& bare_percent) {
  // First what has waited while the clients did not read.
  io.restart();
  io.run_for(kCatchUp);
  for (Subscriber& client : clients) {
    client.states = client.images = {};
    client.topics.clear();
  }
  const double cpu_before = server.cpu_seconds();
  const double start = monotonic_seconds();
  io.restart();
  io.run_for(std::chrono::microseconds(static_cast<int64_t>(time * 1e6)));
  server_percent.push_back((server.cpu_seconds() - cpu_before) / (monotonic_seconds() - start) *
                           100);
  bare_percent.push_back(measure_bare_sender(clients.front(), time));
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
  const uint16_t port = wait_for_port(server, "ws://[^ ]*:(\\d+)");

  const double idle_before = server.cpu_seconds();
  std::this_thread::sleep_for(std::chrono::duration<double>(time));
  const double idle = (server.cpu_seconds() - idle_before) / time * 100;

  asio::io_context io(1);
  std::list<Subscriber> clients;
  for (int i = 0; i < kNumClients; ++i) clients.emplace_back(io, port);
  // All channels have appeared, images come.
  const double deadline = monotonic_seconds() + kDeadline;
  while (clients.front().topics["/NAO/camera/top/image"] < 10) {
    if (monotonic_seconds() > deadline) throw std::runtime_error("no images come");
    io.restart();
    io.run_for(std::chrono::milliseconds(100));
  }
  std::vector<double> server_percent;
  std::vector<double> bare_percent;
  for (int i = 0; i < num_rounds; ++i) {
    measure(io, clients, server, time, server_percent, bare_percent);
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
  std::string json_file;
  int num_rounds = 5;
  double time = 10;
  bool prints_topics = false;
  app.add_option("--json", json_file, "File for the figures as JSON");
  app.add_option("--rounds", num_rounds, "Pairs of measurements; the medians count")
      ->range(1, 1000)
      ->show_default();
  app.add_option("--time", time, "Duration of each measurement, s")
      ->range(1.0, 3600.0)
      ->show_default();
  app.add_flag("--topics", prints_topics, "Also print the rate of every channel");
  if (const auto status = app.parse(argc, argv)) return *status;
  try {
    nao::report(nao::bench::run(num_rounds, time, prints_topics), json_file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nao-bench-foxglove: %s\n", error.what());
    return 1;
  }
  return 0;
}
