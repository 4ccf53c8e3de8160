// Measures the message bus: a message to another process and back, against the same by bare UDP.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "figures.h"

namespace nao {
namespace {

/** About what a robot_state_t has. */
constexpr int kMessageBytes = 1200;
constexpr int kWarmUps = 100;
constexpr int kReceiveTimeoutMs = 500;

double now_us() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(time).count();
}

/** A process that runs `body` until this object ends. */
class Child {
 public:
  template <class Body>
  explicit Child(const Body& body) : process_id_(fork()) {
    if (process_id_ == 0) {
      body();
      _exit(0);
    }
  }
  ~Child() {
    kill(process_id_, SIGKILL);
    waitpid(process_id_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t process_id_;
};

/** Counts what comes back. */
struct EchoCounter {
  int num_received = 0;
  void receive(const lcm::ReceiveBuffer*, const std::string&) { ++num_received; }
};

/** Sends every message back on another channel. */
struct Echo {
  lcm::LCM* lcm;
  void receive(const lcm::ReceiveBuffer* buffer, const std::string&) {
    lcm->publish("BENCH_BACK", buffer->data, buffer->data_size);
  }
};

void run_lcm_echo(const std::string& url) {
  lcm::LCM lcm(url);
  Echo echo{&lcm};
  lcm.subscribe("BENCH_THERE", &Echo::receive, &echo);
  while (lcm.handle() == 0) {
  }
}

/** Round trips through the bus, one at a time. */
class LcmPing {
 public:
  explicit LcmPing(const std::string& url) : echo_([&url] { run_lcm_echo(url); }), lcm_(url) {
    if (!lcm_.good()) throw std::runtime_error("cannot open the bus " + url);
    lcm_.subscribe("BENCH_BACK", &EchoCounter::receive, &counter_);
  }

  /** @return Time of one round trip, µs; negative if the message was lost. */
  double ping() {
    const std::array<char, kMessageBytes> message{};
    const int num_before = counter_.num_received;
    const double start = now_us();
    lcm_.publish("BENCH_THERE", message.data(), kMessageBytes);
    if (lcm_.handleTimeout(kReceiveTimeoutMs) <= 0) return -1;
    return counter_.num_received > num_before ? now_us() - start : -1;
  }

 private:
  Child echo_;
  lcm::LCM lcm_;
  EchoCounter counter_;
};

/** A UDP socket on a loopback port of the system's choice. */
int open_socket(sockaddr_in& address) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM, 0);
  address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (descriptor < 0 ||
      bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::runtime_error("cannot open a UDP socket");
  }
  const timeval timeout{0, kReceiveTimeoutMs * 1000};
  setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  return descriptor;
}

void run_udp_echo(int descriptor, const sockaddr_in& back) {
  std::array<char, kMessageBytes> message{};
  while (true) {
    const ssize_t size = recv(descriptor, message.data(), message.size(), 0);
    if (size > 0) {
      sendto(descriptor, message.data(), static_cast<size_t>(size), 0,
             reinterpret_cast<const sockaddr*>(&back), sizeof back);
    }
  }
}

/** The same without LCM: one socket here, one in the other process. */
class UdpPing {
 public:
  UdpPing()
      : descriptor_(open_socket(own_)),
        echo_descriptor_(open_socket(echo_address_)),
        echo_([this] { run_udp_echo(echo_descriptor_, own_); }) {}
  ~UdpPing() {
    close(descriptor_);
    close(echo_descriptor_);
  }
  UdpPing(const UdpPing&) = delete;
  UdpPing& operator=(const UdpPing&) = delete;

  double ping() {
    std::array<char, kMessageBytes> message{};
    const double start = now_us();
    sendto(descriptor_, message.data(), message.size(), 0,
           reinterpret_cast<const sockaddr*>(&echo_address_), sizeof echo_address_);
    return recv(descriptor_, message.data(), message.size(), 0) > 0 ? now_us() - start : -1;
  }

 private:
  sockaddr_in own_{};
  sockaddr_in echo_address_{};
  int descriptor_;
  int echo_descriptor_;
  Child echo_;
};

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<size_t>(std::lround(share * last))];
}

std::vector<Figure> measure(const std::string& url, int num_rounds) {
  LcmPing lcm(url);
  UdpPing udp;
  for (int i = 0; i < kWarmUps; ++i) {
    lcm.ping();
    udp.ping();
  }
  std::vector<double> lcm_us;
  std::vector<double> udp_us;
  int num_lost = 0;
  // Interleaved, so that a busy moment of the machine hits both alike.
  for (int i = 0; i < num_rounds; ++i) {
    const double by_lcm = lcm.ping();
    const double by_udp = udp.ping();
    if (by_lcm < 0 || by_udp < 0) {
      ++num_lost;
      continue;
    }
    lcm_us.push_back(by_lcm);
    udp_us.push_back(by_udp);
  }
  if (lcm_us.empty()) throw std::runtime_error("no message came back; try: nao bus");
  return {
      {"bus.round_trip_us.p50", percentile(lcm_us, 0.5), "us", "UDP", percentile(udp_us, 0.5)},
      {"bus.round_trip_us.p99", percentile(lcm_us, 0.99), "us", "UDP", percentile(udp_us, 0.99)},
      {"bus.lost", static_cast<double>(num_lost), "messages", "", 0}};
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  CLI::App app("Measures the message bus against bare UDP", "nao-bench-bus");
  std::string url = "udpm://239.255.76.67:7699?ttl=0";
  std::string json_file;
  int num_rounds = 2000;
  app.add_option("--lcm-url", url, "A bus that nobody else uses")->capture_default_str();
  app.add_option("--json", json_file, "File for the figures as JSON");
  app.add_option("--rounds", num_rounds, "Messages to send")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    nao::report(nao::measure(url, num_rounds), json_file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nao-bench-bus: %s\n", error.what());
    return 1;
  }
  return 0;
}
