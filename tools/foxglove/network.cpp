#include "tools/foxglove/network.h"

#include "tools/foxglove/connection.h"
//
#include "phone-gateway/web_stream/asio_loop.h"
#include "phone-gateway/web_stream/listen.h"
#include "phone-gateway/web_stream/own_host.h"

namespace nao::foxglove {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

// Connections of clients and of requests for files together. Chosen: a program fetches some files
// at once; well below the usual limit of 1024 file descriptors.
constexpr size_t kMaxConnections = 200;

AccessRules make_access_rules(const NetworkOptions& options) {
  std::vector<std::string> names = own_host_names();
  names.insert(names.end(), options.host_names.begin(), options.host_names.end());
  return AccessRules(names, options.origins, own_search_domains);
}

}  // namespace

struct Network::Impl {
  Impl(std::unique_ptr<AsioLoop> new_loop, const NetworkOptions& options, ServerCore& core,
       AssetFolder& files)
      : context{new_loop->io(), core, files, make_access_rules(options), options.accepts_viewers},
        loop(std::move(new_loop)),
        listener(loop->io(), options.bind, options.port, "--port", [this](Tcp::socket socket) {
          if (context.num_connections < kMaxConnections) serve(context, std::move(socket));
        }) {}

  // Before `loop`, which destroys the connections: they use the context until then.
  ConnectionContext context;
  std::unique_ptr<AsioLoop> loop;
  TcpListener listener;
};

Network::Network(const NetworkOptions& options, ServerCore& core, AssetFolder& files)
    : impl_(std::make_unique<Impl>(std::make_unique<AsioLoop>(), options, core, files)) {}

Network::~Network() {
  impl_->context.is_shutting_down = true;
}

uint16_t Network::port() const {
  return impl_->listener.port();
}

AsioLoop& Network::loop() {
  return *impl_->loop;
}

}  // namespace nao::foxglove
