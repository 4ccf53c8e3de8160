#include "tools/foxglove/network.h"

#include "tools/foxglove/connection.h"
//
#include <algorithm>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <list>

#include "phone-gateway/web_stream/listen.h"
#include "phone-gateway/web_stream/own_host.h"

namespace nao::foxglove {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using boost::system::error_code;

// Connections of clients and of requests for files together. Chosen: a program fetches some files
// at once; well below the usual limit of 1024 file descriptors.
constexpr size_t kMaxConnections = 200;
// Time until the next attempt after accepting has failed (no file descriptor left).
constexpr auto kAcceptPause = std::chrono::milliseconds(100);

AccessRules make_access_rules(const NetworkOptions& options) {
  std::vector<std::string> names = own_host_names();
  names.insert(names.end(), options.host_names.begin(), options.host_names.end());
  return AccessRules(names, options.origins, own_search_domains);
}

}  // namespace

struct Network::Impl {
  Impl(const NetworkOptions& options, ServerCore& core, AssetFolder& files)
      : context{io, core, files, make_access_rules(options), options.accepts_viewers},
        acceptor(listen(io, options.bind, options.port, "--port")),
        pause(io),
        signals(io, SIGINT, SIGTERM) {
    accept();
    signals.async_wait([this](const error_code& error, int signal) {
      if (error) return;
      reason = signal == SIGINT ? "SIGINT" : "SIGTERM";
      io.stop();
    });
  }

  void accept() {
    acceptor.async_accept([this](const error_code& error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {
        pause.expires_after(kAcceptPause);
        pause.async_wait([this](const error_code& cancelled) {
          if (!cancelled) accept();
        });
        return;
      }
      if (context.num_connections < kMaxConnections) serve(context, std::move(socket));
      accept();
    });
  }

  struct Watched {
    asio::posix::stream_descriptor descriptor;
    std::function<void()> handler;
  };
  void wait(Watched& watched) {
    watched.descriptor.async_wait(asio::posix::stream_descriptor::wait_read,
                                  [this, &watched](const error_code& error) {
                                    if (error) return;
                                    watched.handler();
                                    wait(watched);
                                  });
  }

  struct Timer {
    asio::steady_timer timer;
    std::chrono::nanoseconds period;
    std::function<void()> handler;
  };
  void wait(Timer& timer) {
    timer.timer.expires_after(timer.period);
    timer.timer.async_wait([this, &timer](const error_code& error) {
      if (error) return;
      timer.handler();
      wait(timer);
    });
  }

  // Before `io`, which destroys the connections: they use the context until then.
  ConnectionContext context;
  asio::io_context io{1};
  Tcp::acceptor acceptor;
  asio::steady_timer pause;
  asio::signal_set signals;
  std::list<Watched> watched;
  std::list<Timer> timers;
  std::string reason;
};

Network::Network(const NetworkOptions& options, ServerCore& core, AssetFolder& files)
    : impl_(std::make_unique<Impl>(options, core, files)) {}

Network::~Network() {
  impl_->context.is_shutting_down = true;
  // The caller owns these descriptors.
  for (Impl::Watched& watched : impl_->watched) watched.descriptor.release();
}

uint16_t Network::port() const {
  return impl_->acceptor.local_endpoint().port();
}

void Network::on_readable(int descriptor, std::function<void()> handler) {
  impl_->watched.push_back(
      {asio::posix::stream_descriptor(impl_->io, descriptor), std::move(handler)});
  impl_->wait(impl_->watched.back());
}

void Network::every(double period, std::function<void()> handler) {
  impl_->timers.push_back({asio::steady_timer(impl_->io),
                           std::chrono::nanoseconds(static_cast<int64_t>(period * 1e9)),
                           std::move(handler)});
  impl_->wait(impl_->timers.back());
}

std::string Network::run() {
  impl_->io.run();
  return impl_->reason;
}

}  // namespace nao::foxglove
