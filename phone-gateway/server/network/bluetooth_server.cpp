#include "phone-gateway/server/network/bluetooth_server.h"

#include "phone-gateway/server/network/bluetooth_connection.h"
//
#include <unistd.h>

#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <utility>

#include "common/logger.h"
#include "common/wall_clock.h"

namespace nao::gateway {
namespace {

constexpr std::chrono::seconds kStepPeriod{1};
}  // namespace

struct BluetoothServer::Impl : std::enable_shared_from_this<BluetoothServer::Impl> {
  Impl(ConnectionContext& new_context, const std::string& name)
      : context(new_context),
        service(name, {[this](const std::string& phone, size_t value_bytes) {
                         return begin(phone, value_bytes);
                       },
                       [this](const std::string& phone, std::string_view value) {
                         return write(phone, value);
                       },
                       [this](const std::string& phone) { end(phone); }}),
        timer(new_context.io),
        watched(new_context.io) {}

  bool begin(const std::string& phone, size_t value_bytes) {
    if (const auto before = connection) {
      if (before->phone() != phone) return false;
      before->end("connected anew");
    }
    connection = std::make_shared<BluetoothConnection>(context, service, phone, value_bytes,
                                                       [this] { connection.reset(); });
    connection->start();
    return true;
  }

  bool write(const std::string& phone, std::string_view value) {
    // A copy: the value may end the connection.
    const auto to = connection;
    if (!to || to->phone() != phone) return false;
    to->on_value(value);
    return true;
  }

  void end(const std::string& phone) {
    const auto ended = connection;
    if (ended && (phone.empty() || ended->phone() == phone)) ended->end("closed by the client");
  }

  void step() {
    service.step(monotonic_seconds());
    if (service.is_offered() != was_offered) {
      was_offered = service.is_offered();
      if (was_offered) logger::info("phones find this robot by Bluetooth");
    }
    if (service.problem() != problem) {
      problem = service.problem();
      if (!problem.empty()) {
        logger::warn("no Bluetooth: {}; everything else works on", problem);
      }
    }
    watch();
  }

  /** Waits for what BlueZ sends. The descriptor is a copy: the service closes its own. */
  void watch() {
    if (service.descriptor() == watched_number) return;
    watched_number = service.descriptor();
    error_code ignored;
    watched.close(ignored);
    if (watched_number < 0) return;
    watched.assign(dup(watched_number));
    wait();
  }

  void wait() {
    watched.async_wait(asio::posix::stream_descriptor::wait_read,
                       [self = shared_from_this()](const error_code& error) {
                         if (error || self->is_ended) return;
                         const int number = self->watched_number;
                         self->step();
                         if (self->watched_number == number && number >= 0) self->wait();
                       });
  }

  void tick() {
    step();
    timer.expires_after(kStepPeriod);
    timer.async_wait([self = shared_from_this()](const error_code& error) {
      if (!error && !self->is_ended) self->tick();
    });
  }

  void stop() {
    is_ended = true;
    timer.cancel();
    error_code ignored;
    watched.close(ignored);
    end("");
  }

  ConnectionContext& context;
  BluezService service;
  asio::steady_timer timer;
  asio::posix::stream_descriptor watched;
  int watched_number = -1;
  std::shared_ptr<BluetoothConnection> connection;
  std::string problem;
  bool was_offered = false;
  bool is_ended = false;
};

BluetoothServer::BluetoothServer(ConnectionContext& context, const std::string& name)
    : impl_(std::make_shared<Impl>(context, name)) {
  impl_->tick();
}

BluetoothServer::~BluetoothServer() {
  impl_->stop();
}

}  // namespace nao::gateway
