#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cstdint>
#include <string>

namespace nao {

/** Starts to listen for TCP connections.
 * @param address  Of this host; "0.0.0.0" and "::": all, of IPv4 and, where the host has it, IPv6.
 * @param port     0: any free one.
 * @param option   That chooses another port, for the error's text.
 * @throws Error  if the address or the port cannot be used. */
boost::asio::ip::tcp::acceptor listen(boost::asio::io_context& io, const std::string& address,
                                      uint16_t port, const std::string& option);

}  // namespace nao
