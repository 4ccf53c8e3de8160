#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/constants.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "daemons/vision/field_model.h"
#include "daemons/vision/vision_daemon.h"
#include "robot_model/robot_model.h"

namespace {

/** @throws ConfigError  if the scene has no field, or the start is far off its carpet. */
std::pair<nao::vision::FieldModel, nao::Pose2> read_start(const std::vector<double>& start,
                                                          const std::string& scene) {
  const nao::vision::FieldModel field(nao::SceneFile::find(scene));
  const nao::Pose2 pose{{start[0], start[1]}, nao::wrapped(start[2] * nao::kDegree)};
  // Beside the carpet at most: wherever a person could have put the robot.
  const bool is_near = (pose.position.cwiseAbs() - field.half_carpet()).maxCoeff() < 1;
  if (!is_near || !std::isfinite(pose.heading)) {
    throw nao::ConfigError(fmt::format(
        "--start-pose {:g},{:g},{:g} is not on the field of scene {}: x within {:g} m, y within "
        "{:g} m",
        start[0], start[1], start[2], scene, field.half_carpet().x(), field.half_carpet().y()));
  }
  return {field, pose};
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app("Finds ball, lines, posts and robots in the head cameras' images",
                       "nao-vision");
  nao::CommonOptions common;
  nao::vision::VisionOptions options;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  nao::add_model_option(app, model_name);
  app.add_option(
      "--request", options.request_camera,
      "Request images of this camera, or of any: the robot's first (default: process what others "
      "request)");
  app.add_option("--rate", options.rate, "Images a second of --request, 1 to 30")->range(1.0, 30.0);
  std::vector<double> start_pose;
  app.add_option(
         "--start-pose", start_pose,
         "X,Y,HEADING: pose of the robot on the field when nao-motion starts, m and degrees; "
         "x towards the opponents' goal, y left (default: no pose on the field)")
      ->separated_by(',')
      ->count(3);
  std::string scene_name = "soccer";
  app.add_option("--scene", scene_name, "Scene whose field the robot is on");
  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    const auto model = nao::RobotModel::load(nao::data_path() / "robots" / model_name);
    if (!start_pose.empty()) options.field_start = read_start(start_pose, scene_name);
    if (options.request_camera == "any") {
      if (model.cameras().empty()) throw nao::ConfigError(model.name() + " has no camera");
      options.request_camera = model.cameras().front().name;
    }
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    nao::logger::info("version {}, bus {}, robot {} from {}", nao::version(), common.lcm_url,
                      options.robot, model.folder().string());
    nao::vision::VisionDaemon daemon(bus, model, options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    nao::logger::info("{}: {} images, {} refused, {} messages in, {} out, {} dropped", reason,
                      daemon.num_images(), daemon.num_refused(), bus.counters().num_in,
                      bus.counters().num_out, bus.counters().num_dropped);
  });
}
