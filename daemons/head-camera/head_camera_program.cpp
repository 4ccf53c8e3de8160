#include "daemons/head-camera/head_camera_program.h"

#include <string>
#include <vector>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "daemons/head-camera/head_camera_daemon.h"
#include "daemons/head-camera/head_camera_options.h"
#include "robot_model/robot_model.h"

namespace {

using nao::camera::HeadCameraOptions;

void add_image_options(nao::CommandLine& app, HeadCameraOptions& options) {
  app.add_option("--source", options.source,
                 "Where images come from: rendered from a simulator's state, or v4l2: cameras")
      ->one_of({"rendered", "v4l2"});
  app.add_option("--device", options.devices,
                 "Device file of a camera of --source v4l2, CAMERA=FILE (default: those of the "
                 "robot's head_cameras.yaml)")
      ->count(1);
  app.add_flag("--always", options.always, "Send images although none are requested");
  app.add_option("--camera", options.camera,
                 "Camera of --always (default: the first one of the robot's description)");
  app.add_option("--width", options.width, "Width of --always, pixels: 640, 320 or 160");
  app.add_option("--rate", options.rate, "Images a second of --always, 1 to 30");
  app.add_option("--quality", options.quality, "JPEG quality of requests that give none, 1 to 95");
  app.add_option("--shadow-size", options.shadow_size,
                 "Greatest side of the shadow map, texels; 0: none");
  app.add_option("--egl-platform", options.egl_platform,
                 "EGL platform: auto, device, surfaceless or default");
}

/** Values of the command line that need conversion. */
struct ConvertedValues {
  /** k1, k2. */
  std::vector<double> radial;
  double exposure_ms = 0;
  /** 0: none. */
  uint16_t webots_port = 0;

  void write(HeadCameraOptions& options) const {
    if (webots_port != 0) options.webots_port = webots_port;
    if (!radial.empty()) options.distortion.k1 = radial[0];
    if (radial.size() > 1) options.distortion.k2 = radial[1];
    options.exposure = 1e-3 * exposure_ms;
  }
};

/** Options for what distinguishes a real camera's image from an ideal one. */
void add_sensor_options(nao::CommandLine& app, HeadCameraOptions& options,
                        ConvertedValues& sensor) {
  nao::camera::Distortion& distortion = options.distortion;
  app.add_option("--distortion", sensor.radial,
                 "Radial lens distortion K1 [K2] of the Brown-Conrady model, as OpenCV defines it, "
                 "each -2 to 2; K1 below 0: barrel (default: none)")
      ->count(1, 2);
  app.add_option("--p1", distortion.p1, "Tangential lens distortion p1, -2 to 2");
  app.add_option("--p2", distortion.p2, "Tangential lens distortion p2, -2 to 2");
  app.add_option("--k3", distortion.k3, "Radial lens distortion k3, -2 to 2");
  app.add_option("--noise", options.noise,
                 "Standard deviation of the noise of each color, 0 to 60 levels of 255");
  app.add_option("--exposure", sensor.exposure_ms,
                 "Exposure time, 0 to 33 ms; blurs motion (default: 0)");
  app.add_option("--webots-images", sensor.webots_port,
                 "Also serve YUYV images of 640x480 to programs made for the Webots LoLA "
                 "controller: TCP port, on this host only, of the first camera; the next camera "
                 "has the next port");
}

}  // namespace

int nao::camera::run_head_camera(int argc, char** argv) {
  nao::CommandLine app("Sends the images of the robot's head cameras; needs no screen",
                       "nao-head-camera");
  nao::CommonOptions common;
  HeadCameraOptions options;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  nao::add_model_option(app, model_name);
  add_image_options(app, options);
  ConvertedValues sensor;
  add_sensor_options(app, options, sensor);

  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    sensor.write(options);
    const auto model = nao::RobotModel::load(nao::data_path() / "robots" / model_name);
    options.validate(model);
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    nao::logger::info("version {}, bus {}, robot {} from {}", nao::version(), common.lcm_url,
                      options.robot, model.folder().string());
    nao::camera::HeadCameraDaemon daemon(bus, model, options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    nao::logger::info("{}: {} images taken, {} messages in, {} out, {} dropped", reason,
                      daemon.num_frames(), bus.counters().num_in, bus.counters().num_out,
                      bus.counters().num_dropped);
  });
}
