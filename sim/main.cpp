#include <string>

#include "common/bus.h"
#include "common/command_line.h"
#include "common/event_loop.h"
#include "common/logger.h"
#include "common/program.h"
#include "common/scheduling.h"
#include "sim/sim_daemon.h"
#include "sim/sim_options.h"

int main(int argc, char** argv) {
  nao::CommandLine app("Simulates the robot's world: bodies, contacts, motors, sensors, ball.",
                       "nao-sim");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  nao::sim::SimOptions options;
  std::vector<std::string> more_robots;
  app.add_option("--model", options.model, "Folder of robots/ that describes the robot")
      ->show_default();
  app.add_option("--scene", options.scene, "Surroundings of the robot: soccer or empty")
      ->show_default();
  app.add_option("--posture", options.posture, "Posture that the robot starts in")->show_default();
  app.add_option("--also-robot", more_robots, "Name of a further robot; may be repeated");
  app.add_option("--pace", options.pace,
                 "Simulated seconds per second of wall time, 0 as fast as possible")
      ->range(0.0, 1000.0)
      ->show_default();
  app.add_flag("--lock-step", options.lock_step,
               "Compute a tick only after the joint command for the one before was received");
  app.add_flag("--ideal-sensors", options.ideal_sensors,
               "Sensors without quantization, noise, bias, range or drift");
  app.add_option("--engine", options.engine,
                 "Physics engine: fast, simbody, or mujoco where it was built")
      ->show_default();
  app.add_option("--disturbances", options.disturbances,
                 "How robot and floor differ from their models: none, default, moderate, real, or "
                 "entries of real such as backlash,floor_slope (empty: sensor noise only)");
  app.add_option("--seed", options.seed, "Seed of noise and disturbances")->show_default();
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
  return nao::run_program(app, common, argc, argv, [&] {
    // The period of LoLA's frames.
    if (!options.lola_socket.empty() && options.tick_ms == -1) options.tick_ms = 12;
    options.robots = {common.robot};
    options.robots.insert(options.robots.end(), more_robots.begin(), more_robots.end());
    const bool is_in_real_time = !options.lock_step && options.pace > 0;
    if (is_in_real_time && nao::request_realtime_scheduling(nao::RealtimePriority::kControl))
      nao::logger::info("uses real-time scheduling (SCHED_RR)");
    nao::EventLoop loop;
    nao::Bus bus(common.lcm_url);
    const nao::sim::SimDaemon daemon(bus, loop, options);
    nao::logger::info(
        "version {}, bus {}, channels {}_* and WORLD_*, model {}, scene {}, disturbances \"{}\", "
        "control period {} ms, {}",
        nao::version(), common.lcm_url, common.robot, options.model, options.scene,
        options.disturbances, 1e3 * daemon.core().world().options().period(),
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
