#include <spdlog/spdlog.h>

#include <optional>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/program.h"
#include "daemons/head-camera/head_camera_daemon.h"
#include "daemons/head-camera/head_camera_options.h"
#include "robot_model/robot_model.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Shows what the robot's head camera sees, without a screen",
                       "nao-head-camera");
  nao::CommonOptions common;
  nao::HeadCameraOptions options;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  app.add_option("--model", model_name, "Folder of robots/ that describes the robot")
      ->show_default();
  app.add_flag("--always", options.always, "Send pictures whether or not somebody watches");
  app.add_option("--camera", options.camera, "Camera of --always: top or bottom")->show_default();
  app.add_option("--width", options.width, "Width of --always, pixels: 640, 320 or 160")
      ->show_default();
  app.add_option("--rate", options.rate, "Pictures a second of --always, 1 to 30")->show_default();
  app.add_option("--quality", options.quality, "JPEG quality unless a watcher asks, 1 to 95")
      ->show_default();
  app.add_option("--shadow-size", options.shadow_size, "Side of the shadow map, texels; 0: none")
      ->show_default();
  std::vector<double> distortion;
  app.add_option("--distortion", distortion,
                 "Radial distortion of the lens, K1 and K2; K1 below 0: barrel (default: none)")
      ->count(1, 2);
  app.add_option("--noise", options.noise, "Deviation of each colour, 0 to 60 levels of 255")
      ->show_default();
  double exposure_ms = 0;
  app.add_option("--exposure", exposure_ms,
                 "Time the shutter is open, 0 to 33 ms: what moves is blurred (default: 0)");
  app.add_option("--egl-platform", options.egl_platform,
                 "Way to the graphics driver: auto, device, surfaceless or default")
      ->show_default();

  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    if (!distortion.empty()) options.k1 = distortion[0];
    if (distortion.size() > 1) options.k2 = distortion[1];
    options.exposure = 1e-3 * exposure_ms;
    options.validate();
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    const auto model = nao::RobotModel::load(nao::data_path() / "robots" / model_name);
    spdlog::info("version {}, bus {}, robot {} from {}", nao::version(), common.lcm_url,
                 options.robot, model.folder().string());
    nao::HeadCameraDaemon daemon(bus, model, options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    spdlog::info("{}: {} pictures taken, {} messages in, {} out, {} dropped", reason,
                 daemon.num_frames(), bus.counters().num_in, bus.counters().num_out,
                 bus.counters().num_dropped);
  });
}
