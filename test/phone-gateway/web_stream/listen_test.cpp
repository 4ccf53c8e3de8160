#include "phone-gateway/web_stream/listen.h"

#include <gtest/gtest.h>

#include <boost/asio/connect.hpp>

#include "common/error.h"

namespace nao {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

/** Whether a connection to this address of the host is taken. */
bool is_reached(const char* address, uint16_t port) {
  asio::io_context io;
  Tcp::socket socket(io);
  boost::system::error_code error;
  socket.connect({asio::ip::make_address(address), port}, error);
  return !error;
}

bool has_ipv6() {
  asio::io_context io;
  Tcp::acceptor acceptor(io, Tcp::v6());
  boost::system::error_code error;
  acceptor.bind({asio::ip::address_v6::loopback(), 0}, error);
  return !error;
}

TEST(Listen, ToAllTakesConnectionsOfBothVersionsOfIp) {
  asio::io_context io;
  const Tcp::acceptor acceptor = listen(io, "0.0.0.0", 0, "--port");
  const uint16_t port = acceptor.local_endpoint().port();
  EXPECT_TRUE(is_reached("127.0.0.1", port));
  if (!has_ipv6()) GTEST_SKIP() << "this host has no IPv6";
  EXPECT_TRUE(is_reached("::1", port)) << "a name may lead to an IPv6 address only";
}

TEST(Listen, ToOneAddressTakesNoOther) {
  asio::io_context io;
  const Tcp::acceptor acceptor = listen(io, "127.0.0.1", 0, "--port");
  EXPECT_TRUE(is_reached("127.0.0.1", acceptor.local_endpoint().port()));
  EXPECT_FALSE(is_reached("127.0.0.2", acceptor.local_endpoint().port()));
}

TEST(Listen, NamesWhatIsWrong) {
  asio::io_context io;
  EXPECT_THROW(listen(io, "robot", 0, "--port"), Error);
  const Tcp::acceptor first = listen(io, "127.0.0.1", 0, "--port");
  try {
    (void)listen(io, "127.0.0.1", first.local_endpoint().port(), "--some-port");
    FAIL() << "two listen on one port";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--some-port"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nao
