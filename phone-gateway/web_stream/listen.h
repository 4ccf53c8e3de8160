#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace nao {

/** Starts to listen for TCP connections.
 * @param address  Of this host; "0.0.0.0" and "::": all, of IPv4 and, where the host has it, IPv6.
 * @param port     0: any free one.
 * @param option   That chooses another port, for the error's text.
 * @throws Error  if the address or the port cannot be used. */
boost::asio::ip::tcp::acceptor listen(boost::asio::io_context& io, const std::string& address,
                                      uint16_t port, const std::string& option);

/** Accepts TCP connections, as long as it exists. */
class TcpListener {
 public:
  /** Parameters as of listen(). @param serve  Gets each connection. */
  TcpListener(boost::asio::io_context& io, const std::string& address, uint16_t port,
              const std::string& option, std::function<void(boost::asio::ip::tcp::socket)> serve);
  TcpListener(const TcpListener&) = delete;
  TcpListener& operator=(const TcpListener&) = delete;

  /** Also after close(). */
  uint16_t port() const { return port_; }
  void close() { acceptor_.close(); }

 private:
  void accept();

  boost::asio::ip::tcp::acceptor acceptor_;
  const uint16_t port_;
  boost::asio::steady_timer pause_;
  std::function<void(boost::asio::ip::tcp::socket)> serve_;
};

}  // namespace nao
