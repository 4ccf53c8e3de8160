#include "common/bus.h"
#include "common/command_line.h"
#include "common/data_path.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "daemons/vision/vision_daemon.h"
#include "robot_model/robot_model.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Finds ball, lines, posts and robots in the head cameras' images",
                       "nao-vision");
  nao::CommonOptions common;
  nao::vision::VisionOptions options;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  app.add_option("--model", model_name, "Folder of robots/ that describes the robot")
      ->show_default();
  app.add_option("--request", options.request_camera,
                 "Request images of this camera (default: process what others request)");
  app.add_option("--rate", options.rate, "Images a second of --request, 1 to 30")
      ->show_default()
      ->range(1.0, 30.0);
  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    const auto model = nao::RobotModel::load(nao::data_path() / "robots" / model_name);
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    nao::logger::info("version {}, bus {}, robot {} from {}", nao::version(), common.lcm_url,
                      options.robot, model.folder().string());
    nao::vision::VisionDaemon daemon(bus, model, options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    nao::logger::info("{}: {} images, {} messages in, {} out, {} dropped", reason,
                      daemon.num_images(), bus.counters().num_in, bus.counters().num_out,
                      bus.counters().num_dropped);
  });
}
