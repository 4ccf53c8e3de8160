#include "daemons/robot/robot_options.h"

#include "common/command_line.h"
#include "common/program.h"

namespace nao::robot {

void add_robot_options(CommandLine& app, RobotOptions& options) {
  app.add_option("--lola", options.lola_socket, "Unix socket of the robot's interface LoLA");
  add_model_option(app, options.model);
  app.add_flag("--lock-step", options.lock_step,
               "Answer a frame only when the joint command for it has come, and count frames as "
               "time: with nao-sim --lola --lock-step");
  app.add_flag("--autostart", options.starts_itself,
               "Get stiff without the chest button whenever the robot is upright and nao-motion "
               "runs: for simulators, never for a robot");
  app.add_option("--heartbeat", options.heartbeat,
                 "Open descriptor that gets a byte every 20 ms; set by nao-robot-watchdog")
      ->range(-1, 1 << 20);
}

}  // namespace nao::robot
