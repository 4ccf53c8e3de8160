// nao-foxglove: serves the bus to Foxglove and Lichtblick. See README.md.

#include <naolcm/camera_command_t.hpp>
#include <set>
#include <span>
#include <string>

#include "common/bus.h"
#include "common/channels.h"
#include "common/command_line.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/status_reporter.h"
#include "common/wall_clock.h"
#include "messages/command_publisher.h"
#include "phone-gateway/web_stream/asio_loop.h"
#include "robot_model/robot_model.h"
#include "tools/foxglove/bus_relay.h"
#include "tools/foxglove/client_publisher.h"
#include "tools/foxglove/network.h"

namespace nao::foxglove {
namespace {

constexpr const char* kProgram = "nao-foxglove";
// Period of DAEMON_STATUS and of image requests, s; those are valid for 2 s (camera_command_t).
constexpr double kStatusPeriod = 1.0;
// Period of looking for new subscriptions to images, s. Chosen: not noticed by a user.
constexpr double kCameraPeriod = 0.1;

struct Options {
  NetworkOptions network;
  ClientLimits limits;
  std::string model = "nao";
  int camera_width = 320;
  double camera_rate = 15;
  int max_clients = 16;
  int max_queued_mb = 32;
  bool allow_commands = false;
};

void add_options(CommandLine& app, Options& options) {
  app.add_option("--bind", options.network.bind,
                 "Address to listen on; 0.0.0.0: all, also of IPv6");
  app.add_option("--port", options.network.port, "Port of WebSockets and HTTP; 0: any free");
  add_model_option(app, options.model);
  app.add_option("--camera-width", options.camera_width,
                 "Width of the images that are requested while a client watches them, pixels");
  app.add_option("--camera-rate", options.camera_rate, "Images a second that are requested")
      ->range(1.0, 30.0);
  app.add_option("--max-clients", options.max_clients, "Clients at once")->range(1, 100);
  app.add_option("--max-queued-mb", options.max_queued_mb,
                 "Messages that may wait for one client, MB; a slow client gets the newest")
      ->range(1, 1000);
  app.add_flag("--allow-commands", options.allow_commands,
               "Clients may publish commands: any of them can then move the robot");
  app.add_option("--allow-origin", options.network.origins,
                 "Site whose pages may connect, such as https://app.foxglove.dev (repeatable; "
                 "default: with --allow-commands none, else the published Foxglove and Lichtblick, "
                 "their desktop programs, and pages from this computer). Other programs than "
                 "browsers always may");
  app.add_option("--host-name", options.network.host_names,
                 "Another name of this host that browsers may use (repeatable)");
}

/** Requests images of the cameras that clients watch. */
class ImageRequests {
 public:
  ImageRequests(const CommandPublisher& commands, const RobotChannels& channels,
                const Options& options)
      : commands_(commands), channel_(channels.head_camera_command), options_(options) {}

  /** Requests those of cameras that were not wanted before at once. */
  void update(std::set<std::string> cameras) {
    for (const std::string& camera : cameras) {
      if (!cameras_.contains(camera)) send(camera);
    }
    cameras_ = std::move(cameras);
  }
  void repeat() {
    for (const std::string& camera : cameras_) send(camera);
  }

 private:
  void send(const std::string& camera) {
    naolcm::camera_command_t command{};
    command.camera = camera;
    command.width = options_.camera_width;
    command.rate = options_.camera_rate;
    commands_.publish(channel_, command, kProgram);
  }

  const CommandPublisher& commands_;
  std::string channel_;
  const Options& options_;
  std::set<std::string> cameras_;
};

void run(const CommonOptions& common, Options options) {
  options.limits = {static_cast<size_t>(options.max_clients),
                    static_cast<size_t>(options.max_queued_mb) * 1'000'000};
  const RobotModel model = RobotModel::find(options.model);
  AssetFolder files(model.folder(), model.urdf_file());
  ServerCore core(std::string(kProgram) + " " + version() + ", robot " + common.robot,
                  std::to_string(wall_utime()), options.limits,
                  [&files](std::string_view uri) { return files.read_uri(uri); });
  FoxgloveConverter converter(model, common.robot);
  BusRelay relay(core, converter);
  Bus bus(common.lcm_url);
  const RobotChannels channels(common.robot);
  const CommandPublisher commands(bus, channels);
  ClientPublisher publisher(
      kProgram, common.robot, wall_utime, [&commands] { return commands.robot_utime(); },
      [&bus](const std::string& channel, std::span<const uint8_t> message) {
        bus.publish_raw(channel, message);
      });
  if (options.allow_commands) core.allow_publishing(publisher);
  bus.subscribe_raw(".*", [&relay](const RawMessage& message) {
    relay.receive(message.channel, message.bytes, message.wall_utime);
  });
  options.network.accepts_viewers = !options.allow_commands && options.network.origins.empty();
  Network network(options.network, core, files);
  ImageRequests images(commands, channels, options);
  StatusReporter status(bus, kProgram, common.robot);
  const auto report = [&] {
    const ServerCounters& counters = core.counters();
    status.set_state("ready", std::to_string(core.num_clients()) + " clients");
    status.publish({{"clients", static_cast<double>(core.num_clients())},
                    {"sent_bytes", static_cast<double>(counters.num_sent_bytes)},
                    {"dropped", static_cast<double>(counters.num_dropped)},
                    {"refused", static_cast<double>(counters.num_refused)},
                    {"undecodable", static_cast<double>(relay.num_undecodable())}});
  };

  network.loop().on_readable(bus.descriptor(), [&bus] { bus.handle(); });
  network.loop().every(kCameraPeriod, [&] { images.update(relay.wanted_cameras()); });
  network.loop().every_aligned(kStatusPeriod, [&] {
    images.repeat();
    status.tick(monotonic_seconds());
    report();
  });
  logger::info("version {}, bus {}, robot {} from {}", version(), common.lcm_url, common.robot,
               model.folder().string());
  logger::info("listening: ws://{}:{}", options.network.bind, network.port());
  report();

  const std::string reason = network.loop().run();
  const ServerCounters& counters = core.counters();
  logger::info("stopped: {}; {} clients, {} messages sent, {} dropped, {} requests refused", reason,
               counters.num_clients, counters.num_sent, counters.num_dropped, counters.num_refused);
}

}  // namespace
}  // namespace nao::foxglove

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Serves every channel of the bus to Foxglove and Lichtblick by the Foxglove WebSocket "
      "protocol, and the robot's URDF over HTTP. Read-only unless --allow-commands is given.",
      "nao-foxglove");
  nao::CommonOptions common;
  nao::foxglove::Options options;
  nao::add_common_options(app, common);
  nao::foxglove::add_options(app, options);
  return nao::run_program(app, common, argc, argv,
                          [&] { nao::foxglove::run(common, std::move(options)); });
}
