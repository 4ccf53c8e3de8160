#include "phone-gateway/web_stream/listen.h"

#include <boost/asio/ip/v6_only.hpp>

#include "common/error.h"

namespace nao {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using boost::system::error_code;

/** Time until the next attempt after accepting has failed (no file descriptor left). */
constexpr auto kAcceptPause = std::chrono::milliseconds(100);

error_code listen_at(Tcp::acceptor& acceptor, const Tcp::endpoint& endpoint) {
  error_code error;
  acceptor.close(error);
  acceptor.open(endpoint.protocol(), error);
  if (error) return error;
  // A program that starts again must not wait for the old connections' TIME_WAIT.
  acceptor.set_option(Tcp::acceptor::reuse_address(true));
  if (endpoint.address().is_v6()) acceptor.set_option(asio::ip::v6_only(false), error);
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  return error;
}

}  // namespace

Tcp::acceptor listen(asio::io_context& io, const std::string& address, uint16_t port,
                     const std::string& option) {
  error_code error;
  const asio::ip::address ip = asio::ip::make_address(address, error);
  if (error) throw Error("--bind " + address + " is not an IP address");
  Tcp::acceptor acceptor(io);
  // A name may lead to an IPv6 address only; one socket takes connections of both.
  const bool is_all = ip.is_unspecified();
  error = listen_at(acceptor, {is_all ? asio::ip::address(asio::ip::address_v6::any()) : ip, port});
  const bool has_no_v6 = error == asio::error::address_family_not_supported ||
                         error == boost::system::errc::address_not_available;
  if (is_all && has_no_v6) error = listen_at(acceptor, {asio::ip::address_v4::any(), port});
  const std::string where = "port " + std::to_string(port) + " of " + address;
  if (error == asio::error::address_in_use) {
    throw Error(where + " is in use by another program: stop it, or choose another with " + option);
  }
  if (error) throw Error("cannot listen on " + where + ": " + error.message());
  return acceptor;
}

TcpListener::TcpListener(asio::io_context& io, const std::string& address, uint16_t port,
                         const std::string& option, std::function<void(Tcp::socket)> serve)
    : acceptor_(listen(io, address, port, option)),
      port_(acceptor_.local_endpoint().port()),
      pause_(io),
      serve_(std::move(serve)) {
  accept();
}

void TcpListener::accept() {
  acceptor_.async_accept([this](const error_code& error, Tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {
      pause_.expires_after(kAcceptPause);
      pause_.async_wait([this](const error_code& cancelled) {
        if (!cancelled) accept();
      });
      return;
    }
    serve_(std::move(socket));
    accept();
  });
}

}  // namespace nao
