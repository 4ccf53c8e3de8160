#pragma once

#include <google/protobuf/stubs/logging.h>

#include <atomic>
#include <future>
#include <memory>
#include <thread>

#include "common/wall_clock.h"
#include "phone-gateway/server/bus/gateway_daemon.h"
#include "phone-gateway/server/network/network.h"
#include "phone-gateway/web_stream/asio_loop.h"
#include "test/phone-gateway/server/core/test_robot.h"
#include "test/support/fake_motion.h"
#include "test/support/temporary_folder.h"

namespace nao::gateway {

/** A whole gateway in a thread of its own, with sockets on free ports of 127.0.0.1 and a fake robot
 * on a bus inside the process. */
class LiveGateway {
 public:
  struct Options {
    GatewayLimits limits;
    /** Rate of the images, 1/s, and their size, bytes. */
    double image_rate = 15;
    int image_bytes = 7000;
  };

  LiveGateway() : LiveGateway(Options()) {}
  explicit LiveGateway(const Options& options) {
    google::protobuf::SetLogHandler(nullptr);
    std::promise<void> is_ready;
    thread_ = std::thread([this, options, &is_ready] { run(options, is_ready); });
    is_ready.get_future().get();
  }
  ~LiveGateway() {
    is_stopping_ = true;
    thread_.join();
  }

  uint16_t http_port() const { return http_port_; }
  uint16_t tcp_port() const { return tcp_port_; }
  FakeMotion& motion() { return *motion_; }
  /** Open connections, with or without Connect. */
  int num_sessions() const { return num_sessions_; }

 private:
  void run(const Options& options, std::promise<void>& is_ready) {
    try {
      Bus bus("memq://");
      FakeMotion motion(bus, {"HeadYaw", "HeadPitch", "LShoulderRoll", "LHand"});
      GatewayDaemon daemon(bus, {make_test_robot()}, options.limits, "secret");
      TemporaryFolder data;
      std::filesystem::create_directories(data.path() / "web");
      write_text(data.path() / "web" / "index.html", "<p>app</p>");
      WebPages pages(data.path());
      NetworkOptions network_options;
      network_options.bind = "127.0.0.1";
      network_options.http_port = 0;
      network_options.tcp_port = 0;
      Network network(network_options, AccessRules({}, {}), daemon.core(), pages);
      pages.add_page("/metrics",
                     {"text/plain", true, [&] { return daemon.metrics_text(network.metrics()); }});
      bool has_started = false;
      network.loop().on_readable(bus.descriptor(), [&] { bus.handle(); });
      network.loop().every(0.01, [&] { motion.step(); });
      network.loop().every(1 / options.image_rate,
                           [&] { motion.send_image(320, options.image_bytes); });
      network.loop().every(0.02, [&] {
        daemon.step(monotonic_seconds());
        num_sessions_ = static_cast<int>(daemon.core().sessions().all().size());
        if (is_stopping_) network.loop().stop("test");
        if (!has_started && daemon.core().robot().components().is_available(Component::kRobot)) {
          has_started = true;
          is_ready.set_value();
        }
      });
      http_port_ = network.http_port();
      tcp_port_ = network.tcp_port();
      motion_ = &motion;
      network.loop().run();
      daemon.shut_down(monotonic_seconds());
      network.drain(0.05);
    } catch (...) {
      is_ready.set_exception(std::current_exception());
    }
  }

  std::thread thread_;
  std::atomic<bool> is_stopping_ = false;
  std::atomic<int> num_sessions_ = 0;
  uint16_t http_port_ = 0;
  uint16_t tcp_port_ = 0;
  FakeMotion* motion_ = nullptr;
};

}  // namespace nao::gateway
