#include "daemons/motion/motion_program.h"

#include <string>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/scheduling.h"
#include "daemons/motion/motion_daemon.h"
#include "robot_model/robot_model.h"

int nao::motion::run_motion(int argc, char** argv) {
  nao::CommandLine app(
      "Computes the robot's joint targets: walks, postures, joint changes, actions, falls.",
      "nao-motion");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  std::string calibration_file;
  nao::motion::MotionOptions options;
  nao::add_model_option(app, model_name);
  app.add_option("--default-speed", options.default_speed,
                 "Speed of the robot's own motions, fraction of the maximum");
  app.add_option(
      "--policy", options.policy,
      "Policy that walks or gets up: a folder in policies/ of the robot; none: get-ups are "
      "model-based");
  app.add_option("--calibration", calibration_file,
                 "File of the robot's own joint and sensor errors, as nao calibrate writes it");
  app.add_flag("!--no-get-up", options.gets_up, "After a fall, remain lying until a command");
  return nao::run_program(app, common, argc, argv, [&] {
    // Errors of the model end the program here, before it answers on any channel.
    const nao::RobotModel model = nao::RobotModel::find(model_name);
    if (nao::request_realtime_scheduling(nao::RealtimePriority::kControl))
      nao::logger::info("real-time scheduling granted");
    if (!calibration_file.empty()) {
      options.calibration = nao::Calibration::load(model, calibration_file);
      nao::logger::info("calibration {} of {}", calibration_file, options.calibration->date);
    }
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    const nao::motion::MotionDaemon daemon(bus, loop, model, options, common.robot);
    nao::logger::info("version {}, bus {}, channels {}_*, model {}", nao::version(), common.lcm_url,
                      common.robot, model.folder().string());
    const std::string reason = loop.run();
    nao::logger::info("stopped by {} after {} steps; {} messages in, {} out, {} dropped", reason,
                      daemon.num_steps(), bus.counters().num_in, bus.counters().num_out,
                      bus.counters().num_dropped);
  });
}
