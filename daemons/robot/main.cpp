#include <string>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/error.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/scheduling.h"
#include "daemons/robot/robot_daemon.h"
#include "daemons/robot/robot_options.h"
#include "robot_model/robot_model.h"

namespace {

/** Time allowed to sit down and go limp, s: twice the usual time. */
constexpr double kEndTime = 6;

/** Makes the robot sit down, even if further signals arrive. */
void end(nao::EventLoop& loop, nao::robot::RobotDaemon& daemon) {
  // The wait is limited: without frames the robot cannot be moved.
  bool is_too_late = false;
  loop.every(kEndTime, [&] {
    is_too_late = true;
    loop.stop("time-out");
  });
  daemon.begin_end();
  while (!daemon.has_ended() && !is_too_late) loop.run();
  // The watchdog then tries it.
  if (!daemon.has_ended()) throw nao::Error("LoLA sends no frames: the robot may still be stiff");
}

}  // namespace

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Connects a NAO V6 to the bus by its interface LoLA, and keeps it safe. Start it by "
      "nao-robot-watchdog.",
      "nao-robot");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  nao::robot::RobotOptions options;
  nao::robot::add_robot_options(app, options);
  return nao::run_program(app, common, argc, argv, [&] {
    const nao::RobotModel model = nao::RobotModel::find(options.model);
    if (!options.lock_step && nao::request_realtime_scheduling(nao::RealtimePriority::kControl))
      nao::logger::info("real-time scheduling granted");
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    nao::robot::RobotDaemon daemon(bus, loop, model, options, common.robot);
    nao::logger::info("version {}, bus {}, channels {}_*, model {}, LoLA at {}", nao::version(),
                      common.lcm_url, common.robot, model.folder().string(), options.lola_socket);
    const std::string reason = loop.run();
    // Signals end the loop; before the program ends, the robot sits down and its motors become
    // limp.
    if (!daemon.has_ended()) end(loop, daemon);
    nao::logger::info("stopped by {} after {} frames; {} messages in, {} out, {} dropped", reason,
                      daemon.num_frames(), bus.counters().num_in, bus.counters().num_out,
                      bus.counters().num_dropped);
  });
}
