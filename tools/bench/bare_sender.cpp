// nao-bare-sender: the baseline of servers of many clients. A Boost.Asio loop that sends the same
// number of bytes at the same rate to the same number of TCP connections and does nothing else.
//
// nao-bare-sender RATE_1 BYTES_1 RATE_2 BYTES_2 [LCM_URL CHANNEL]: prints its port, then serves
// until SIGTERM. With a channel of robot_state_t it also does what no gateway can avoid: it
// receives every state, sends the first ones at those times, each client with a phase of its own,
// and reads what the clients send.
#include <utility>
//
#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <list>
#include <naolcm/robot_state_t.hpp>
#include <optional>
#include <string>

#include "common/bus.h"
#include "common/wall_clock.h"

namespace {

/** Phases spread evenly, as the gateway's. */
constexpr double kGoldenRatioFraction = 0.6180339887;

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

struct Connection {
  Tcp::socket socket;
  std::deque<const std::string*> queue;
  /** When the next message of the first kind is due, s. */
  double due = 0;
  std::array<char, 1024> received;

  void send(const std::string* bytes) {
    queue.push_back(bytes);
    if (queue.size() == 1) write();
  }
  void write() {
    asio::async_write(socket, asio::buffer(*queue.front()),
                      [this](const boost::system::error_code& error, size_t) {
                        if (error) std::exit(0);
                        queue.pop_front();
                        if (!queue.empty()) write();
                      });
  }
  void read() {
    socket.async_read_some(asio::buffer(received),
                           [this](const boost::system::error_code& error, size_t) {
                             if (!error) read();
                           });
  }
};

class Stream {
 public:
  Stream(asio::io_context& io, std::list<Connection>& connections, double rate, size_t num_bytes)
      : connections_(connections),
        timer_(io, std::chrono::steady_clock::now()),
        period_(static_cast<int64_t>(1e9 / rate)),
        bytes_(num_bytes, 'x') {
    wait();
  }

 private:
  void wait() {
    timer_.expires_at(timer_.expiry() + period_);
    timer_.async_wait([this](const boost::system::error_code&) {
      for (Connection& connection : connections_) connection.send(&bytes_);
      wait();
    });
  }

  std::list<Connection>& connections_;
  asio::steady_timer timer_;
  std::chrono::nanoseconds period_;
  std::string bytes_;
};

/** Sends a message at the states of a robot, reduced to a rate. */
class StateStream {
 public:
  StateStream(asio::io_context& io, std::list<Connection>& connections, double rate,
              size_t num_bytes, const std::string& url, const std::string& channel)
      : connections_(connections),
        period_(1 / rate),
        bytes_(num_bytes, 'x'),
        bus_(url),
        descriptor_(io, bus_.descriptor()) {
    bus_.subscribe<naolcm::robot_state_t>(channel, nao::Bus::Queue::kLatest,
                                          [this](const naolcm::robot_state_t&) { send(); });
    wait();
  }
  ~StateStream() { descriptor_.release(); }
  StateStream(const StateStream&) = delete;
  StateStream& operator=(const StateStream&) = delete;

 private:
  void wait() {
    descriptor_.async_wait(asio::posix::stream_descriptor::wait_read,
                           [this](const boost::system::error_code&) {
                             bus_.handle();
                             wait();
                           });
  }
  void send() {
    const double now = nao::monotonic_seconds();
    double phase = 0;
    for (Connection& connection : connections_) {
      phase = std::fmod(phase + kGoldenRatioFraction, 1);
      if (connection.due == 0) connection.due = now + phase * period_;
      if (now < connection.due) continue;
      connection.due += period_;
      connection.send(&bytes_);
    }
  }

  std::list<Connection>& connections_;
  double period_;
  std::string bytes_;
  nao::Bus bus_;
  asio::posix::stream_descriptor descriptor_;
};

void accept(Tcp::acceptor& acceptor, std::list<Connection>& connections) {
  acceptor.async_accept([&](const boost::system::error_code& error, Tcp::socket socket) {
    if (error) std::exit(1);
    socket.set_option(Tcp::no_delay(true));
    connections.push_back({std::move(socket), {}, 0, {}});
    connections.back().read();
    accept(acceptor, connections);
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 && argc != 7) {
    std::cerr << "nao-bare-sender RATE_1 BYTES_1 RATE_2 BYTES_2 [LCM_URL CHANNEL]\n";
    return 2;
  }
  asio::io_context io(1);
  std::list<Connection> connections;
  Tcp::acceptor acceptor(io, Tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  accept(acceptor, connections);
  std::optional<Stream> first;
  std::optional<StateStream> at_states;
  if (argc == 7) {
    at_states.emplace(io, connections, std::atof(argv[1]), std::strtoul(argv[2], nullptr, 10),
                      argv[5], argv[6]);
  } else {
    first.emplace(io, connections, std::atof(argv[1]), std::strtoul(argv[2], nullptr, 10));
  }
  const Stream second(io, connections, std::atof(argv[3]), std::strtoul(argv[4], nullptr, 10));
  std::cout << "port " << acceptor.local_endpoint().port() << std::endl;
  io.run();
}
