#include "sim/sim_program.h"

#include <fmt/ranges.h>

#include <cstdio>
#include <string>
#include <vector>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/robot_option.h"
#include "common/scheduling.h"
#include "sim/sim_daemon.h"
#include "sim/sim_options.h"
#include "sim/start_places.h"

namespace {

void print_places(const nao::sim::SimOptions& options) {
  const auto robots = nao::sim::with_teams(options.robots);
  const auto places = nao::sim::start_places(robots, nao::SceneFile::find(options.scene));
  for (size_t i = 0; i < robots.size(); ++i) {
    const nao::RobotOption& robot = robots[i];
    std::puts(fmt::format("{} {} {} {} {}", robot.name, robot.model,
                          robot.team ? std::to_string(*robot.team) : "-",
                          robot.team ? std::to_string(robot.number) : "-",
                          nao::sim::start_pose_text(robot, places[i]))
                  .c_str());
  }
}

}  // namespace

int nao::sim::run_sim(int argc, char** argv) {
  nao::CommandLine app("Simulates the robot's world: bodies, contacts, motors, sensors, ball.",
                       "nao-sim");
  nao::CommonOptions common;
  nao::add_bus_options(app, common);
  nao::sim::SimOptions options;
  std::vector<std::string> robots{common.robot};
  std::string model = "nao";
  bool prints_places = false;
  nao::add_robot_option(app, robots);
  app.add_option("--model", model, "Folder of robots/ that describes robots without a model");
  app.add_option("--scene", options.scene,
                 "Surroundings of the robot, a file of scenes/: soccer, empty, hsl_small, ...");
  app.add_option("--posture", options.posture, "Posture that the robots start in");
  app.add_option("--pace", options.pace,
                 "Simulated seconds per second of wall time, 0 as fast as possible")
      ->range(0.0, 1000.0);
  app.add_flag("--lock-step", options.lock_step,
               "Compute a tick only after the joint command for the one before was received");
  app.add_flag("--ideal-sensors", options.ideal_sensors,
               "Sensors without quantization, noise, bias, range or drift");
  app.add_option("--engine", options.engine,
                 "Physics engine: fast, simbody, or mujoco where it was built");
  app.add_option("--threads", options.num_threads,
                 "Threads that compute the physics of robots which are far from each other; "
                 "the result does not depend on it")
      ->range(1, 64);
  app.add_option("--disturbances", options.disturbances,
                 "How robot and floor differ from their models: none, default, moderate, real, or "
                 "entries of real such as backlash,floor_slope (empty: sensor noise only)");
  app.add_option("--seed", options.seed, "Seed of noise and disturbances");
  app.add_option("--tick-ms", options.tick_ms,
                 "Control period, ms: a multiple of the physics step of 2 ms (default: as the "
                 "disturbances say, or 10)")
      ->range(2, 100);
  app.add_option("--command-latency-ticks", options.command_latency_ticks,
                 "Control ticks between a joint command and the motors' following it (default: as "
                 "the disturbances say, or 1)")
      ->range(0, 10);
  app.add_option(
      "--lola", options.lola_socket,
      "Serve the robot on a Unix socket as a NAO V6 does, with 12 ms ticks, instead of on "
      "the bus; nao-robot is its client");
  app.add_flag("--print-places", prints_places,
               "Print each robot's name, model, team and number (- outside a match) and start as "
               "its team sees the field, X,Y,HEADING in m and degrees, and end");
  return nao::run_program(app, common, argc, argv, [&] {
    // The period of LoLA's frames.
    if (!options.lola_socket.empty() && options.tick_ms == -1) options.tick_ms = 12;
    options.robots = nao::parse_robot_options(robots, model);
    if (prints_places) return print_places(options);
    const bool is_in_real_time = !options.lock_step && options.pace > 0;
    if (is_in_real_time && nao::request_realtime_scheduling(nao::RealtimePriority::kControl))
      nao::logger::info("uses real-time scheduling (SCHED_RR)");
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    const nao::sim::SimDaemon daemon(bus, loop, options);
    nao::logger::info(
        "version {}, bus {}, robots {}, WORLD_*, scene {}, disturbances \"{}\", "
        "control period {} ms, {}",
        nao::version(), common.lcm_url, fmt::join(robots, " "), options.scene, options.disturbances,
        1e3 * daemon.core().world().options().period(),
        options.lock_step ? std::string("lock-step") : "pace " + std::to_string(options.pace));
    const std::string reason = loop.run();
    nao::logger::info(
        "stopped by {} at tick {}; {} late ticks, {} late commands; {} messages in, {} "
        "out, {} dropped",
        reason, daemon.core().world().tick(), daemon.core().scheduler().num_late_ticks(),
        daemon.core().scheduler().num_late_commands(), bus.counters().num_in,
        bus.counters().num_out, bus.counters().num_dropped);
  });
}
