// Measures the message bus: round-trip time of a message to another process, and throughput.
// Baseline: the same over plain UDP.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/run_benchmark.h"

namespace nao {
namespace {

/** Message size, bytes: about that of a robot_state_t. */
constexpr int kMessageBytes = 1200;
constexpr int kWarmUps = 100;
/** Burst length of the throughput measurement: below LCM's default queue of 30 messages, so that
 * none is dropped. */
constexpr int kBurst = 16;
constexpr int kReceiveTimeoutMs = 500;

double now_us() {
  const auto time = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(time).count();
}

/** A child process that runs `body` until this object is destroyed. */
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

/** Header of every message. */
struct Header {
  /** Number of the message's burst. */
  int32_t burst = 0;
  /** In a request: 1 in the burst's last message, which is answered. In an answer: number of
   * received messages of the burst. */
  int32_t number = 0;
};

using Message = std::array<uint8_t, kMessageBytes>;

Message make_message(Header header) {
  Message message{};
  std::memcpy(message.data(), &header, sizeof header);
  return message;
}

Header header_of(const void* bytes) {
  Header header;
  std::memcpy(&header, bytes, sizeof header);
  return header;
}

/** Counts the messages of a burst. */
class BurstCounter {
 public:
  /** @return The answer, after the burst's last message; nullopt otherwise. */
  std::optional<Message> add(Header header) {
    if (header.burst != burst_) num_received_ = 0;
    burst_ = header.burst;
    ++num_received_;
    if (header.number != 1) return std::nullopt;
    return make_message({burst_, num_received_});
  }

 private:
  int32_t burst_ = -1;
  int32_t num_received_ = 0;
};

/** Result of one burst. */
struct Exchange {
  /** Time from sending the first message to receiving the answer, µs. */
  double time_us = 0;
  int num_lost = 0;
};

/** Sends a burst and waits for the answer to its last message.
 * @param send  Sends a message.
 * @param receive  Waits for an answer; nullopt after kReceiveTimeoutMs. */
template <class Send, class Receive>
Exchange exchange_burst(int32_t burst, int num_messages, const Send& send, const Receive& receive) {
  const double start = now_us();
  for (int i = 1; i < num_messages; ++i) send(make_message({burst, 0}));
  send(make_message({burst, 1}));
  // A late answer to an earlier burst must not count for this one.
  std::optional<Header> answer;
  do {
    answer = receive();
  } while (answer && answer->burst != burst);
  return {now_us() - start, answer ? num_messages - answer->number : num_messages};
}

/** Answers every burst. */
struct LcmEcho {
  lcm::LCM* lcm;
  BurstCounter counter;
  void receive(const lcm::ReceiveBuffer* buffer, const std::string&) {
    if (const auto answer = counter.add(header_of(buffer->data))) {
      lcm->publish("BENCH_BACK", answer->data(), kMessageBytes);
    }
  }
};

void run_lcm_echo(const std::string& url) {
  lcm::LCM lcm(url);
  LcmEcho echo{&lcm, {}};
  lcm.subscribe("BENCH_THERE", &LcmEcho::receive, &echo);
  while (lcm.handle() == 0) {
  }
}

/** Messages to another process through the bus. */
class LcmClient {
 public:
  explicit LcmClient(const std::string& url) : echo_([&url] { run_lcm_echo(url); }), lcm_(url) {
    if (!lcm_.good()) throw std::runtime_error("cannot open the bus " + url);
    lcm_.subscribe("BENCH_BACK", &LcmClient::take, this);
  }

  Exchange exchange(int32_t burst, int num_messages) {
    return exchange_burst(
        burst, num_messages,
        [this](const Message& message) {
          lcm_.publish("BENCH_THERE", message.data(), kMessageBytes);
        },
        [this]() -> std::optional<Header> {
          if (lcm_.handleTimeout(kReceiveTimeoutMs) <= 0) return std::nullopt;
          return answer_;
        });
  }

 private:
  void take(const lcm::ReceiveBuffer* buffer, const std::string&) {
    answer_ = header_of(buffer->data);
  }

  Child echo_;
  lcm::LCM lcm_;
  Header answer_;
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
  return descriptor;
}

void send_to(int descriptor, const Message& message, const sockaddr_in& address) {
  sendto(descriptor, message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&address),
         sizeof address);
}

void run_udp_echo(int descriptor, const sockaddr_in& back) {
  Message message{};
  BurstCounter counter;
  while (true) {
    if (recv(descriptor, message.data(), message.size(), 0) <= 0) continue;
    if (const auto answer = counter.add(header_of(message.data()))) {
      send_to(descriptor, *answer, back);
    }
  }
}

/** Baseline without LCM: one UDP socket here, one in the other process. */
class UdpPeer {
 public:
  UdpPeer()
      : descriptor_(open_socket(own_)),
        echo_descriptor_(open_socket(echo_address_)),
        echo_([this] { run_udp_echo(echo_descriptor_, own_); }) {
    const timeval timeout{0, kReceiveTimeoutMs * 1000};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  }
  ~UdpPeer() {
    close(descriptor_);
    close(echo_descriptor_);
  }
  UdpPeer(const UdpPeer&) = delete;
  UdpPeer& operator=(const UdpPeer&) = delete;

  Exchange exchange(int32_t burst, int num_messages) {
    return exchange_burst(
        burst, num_messages,
        [this](const Message& message) { send_to(descriptor_, message, echo_address_); },
        [this]() -> std::optional<Header> {
          Message message{};
          if (recv(descriptor_, message.data(), message.size(), 0) <= 0) return std::nullopt;
          return header_of(message.data());
        });
  }

 private:
  sockaddr_in own_{};
  sockaddr_in echo_address_{};
  int descriptor_;
  int echo_descriptor_;
  Child echo_;
};

/** Results of many bursts. */
struct Times {
  std::vector<double> us;
  int num_lost = 0;

  void add(const Exchange& exchange) {
    num_lost += exchange.num_lost;
    if (exchange.num_lost == 0) us.push_back(exchange.time_us);
  }
};

/** Interleaves bursts through LCM and UDP, so that other load on the machine affects both equally.
 */
std::pair<Times, Times> exchange_in_turns(LcmClient& lcm, UdpPeer& udp, int num_messages,
                                          int num_rounds, int32_t& burst) {
  std::pair<Times, Times> times;
  for (int i = 0; i < num_rounds; ++i) {
    times.first.add(lcm.exchange(++burst, num_messages));
    times.second.add(udp.exchange(++burst, num_messages));
  }
  if (times.first.us.empty() || times.second.us.empty()) {
    throw std::runtime_error("no message came back; try: nao bus");
  }
  return times;
}

std::vector<Figure> measure(const std::string& url, int num_rounds) {
  LcmClient lcm(url);
  UdpPeer udp;
  int32_t burst = 0;
  for (int i = 0; i < kWarmUps; ++i) {
    lcm.exchange(++burst, 1);
    udp.exchange(++burst, 1);
  }
  const auto [lcm_trips, udp_trips] = exchange_in_turns(lcm, udp, 1, num_rounds, burst);
  const auto [lcm_bursts, udp_bursts] = exchange_in_turns(lcm, udp, kBurst, num_rounds, burst);
  const auto per_second = [](const Times& times) {
    return kBurst / percentile(times.us, 0.5) * 1e6;
  };
  return {{"bus.round_trip_us.p50", percentile(lcm_trips.us, 0.5), "us", "UDP",
           percentile(udp_trips.us, 0.5)},
          {"bus.round_trip_us.p99", percentile(lcm_trips.us, 0.99), "us", "UDP",
           percentile(udp_trips.us, 0.99)},
          {"bus.messages_per_s", per_second(lcm_bursts), "1/s", "UDP", per_second(udp_bursts)},
          {"bus.mb_per_s", per_second(lcm_bursts) * kMessageBytes * 1e-6, "MB/s", "UDP",
           per_second(udp_bursts) * kMessageBytes * 1e-6},
          {"bus.lost", static_cast<double>(lcm_trips.num_lost + lcm_bursts.num_lost), "messages",
           "", 0}};
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  nao::CommandLine app("Measures the message bus against bare UDP", "nao-bench-bus");
  std::string url = "udpm://239.255.76.67:7699?ttl=0";
  int num_rounds = 2000;
  app.add_option("--lcm-url", url, "Bus without other traffic");
  app.add_option("--rounds", num_rounds, "Messages to send")->positive();
  return nao::run_benchmark(app, argc, argv, [&] { return nao::measure(url, num_rounds); });
}
