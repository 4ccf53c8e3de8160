// nao-bare-sender: the baseline of the gateway with 32 clients. A Boost.Asio loop that sends the
// same number of bytes at the same rate to the same number of TCP connections and does nothing
// else.
//
// nao-bare-sender RATE_1 BYTES_1 RATE_2 BYTES_2: prints its port, then serves until SIGTERM.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <list>
#include <string>

namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

struct Connection {
  Tcp::socket socket;
  std::deque<const std::string*> queue;

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

void accept(Tcp::acceptor& acceptor, std::list<Connection>& connections) {
  acceptor.async_accept([&](const boost::system::error_code& error, Tcp::socket socket) {
    if (error) std::exit(1);
    socket.set_option(Tcp::no_delay(true));
    connections.push_back({std::move(socket), {}});
    accept(acceptor, connections);
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "nao-bare-sender RATE_1 BYTES_1 RATE_2 BYTES_2\n";
    return 2;
  }
  asio::io_context io(1);
  std::list<Connection> connections;
  Tcp::acceptor acceptor(io, Tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  accept(acceptor, connections);
  const Stream first(io, connections, std::atof(argv[1]), std::strtoul(argv[2], nullptr, 10));
  const Stream second(io, connections, std::atof(argv[3]), std::strtoul(argv[4], nullptr, 10));
  std::cout << "port " << acceptor.local_endpoint().port() << std::endl;
  io.run();
}
