// nao-play: behaviors of the robot. See README.md.
#include <vector>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/constants.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "daemons/play/play_daemon.h"
#include "robot_model/robot_model.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Makes the robot act on what it sees: go to the ball, score, keep the goal",
                       "nao-play");
  nao::CommonOptions common;
  nao::play::PlayOptions options;
  nao::add_common_options(app, common);
  std::string model_name = "nao";
  std::vector<double> start_pose = {0, 0, 0};
  nao::add_model_option(app, model_name);
  app.add_option("--scene", options.scene, "Scene with the field's dimensions");
  app.add_option(
         "--start-pose", start_pose,
         "X,Y,HEADING: pose of the robot on the field when nao-motion starts, used until "
         "nao-vision says where it is; m and degrees; x towards the opponent's goal, y left "
         "(default: 0,0,0)")
      ->separated_by(',')
      ->count(3);
  app.add_flag(
      "--autonomous", options.is_autonomous,
      "Play matches by itself; once another program has commanded the robot, wait for its release");
  return nao::run_program(app, common, argc, argv, [&] {
    options.robot = common.robot;
    options.start_in_field = {{start_pose[0], start_pose[1]}, start_pose[2] * nao::kDegree};
    const auto model = nao::RobotModel::find(model_name);
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    nao::logger::info("version {}, bus {}, robot {} from {}, scene {}", nao::version(),
                      common.lcm_url, options.robot, model.folder().string(), options.scene);
    nao::play::PlayDaemon daemon(bus, model, options);
    daemon.attach(loop);
    const std::string reason = loop.run();
    daemon.shut_down(nao::monotonic_seconds());
    nao::logger::info("{}: {} messages in, {} out, {} dropped", reason, bus.counters().num_in,
                      bus.counters().num_out, bus.counters().num_dropped);
  });
}
