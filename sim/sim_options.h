#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/robot_option.h"

namespace nao::sim {

/** Options of nao-sim's command line. */
struct SimOptions {
  /** Scene: scenes/NAME.yaml of the data folder. */
  std::string scene = "soccer";
  /** The robots. An even number without teams becomes two teams, see with_teams(). */
  std::vector<RobotOption> robots{{"NAO", "nao"}};
  /** Posture that the robots start in. */
  std::string posture{};
  /** See WorldOptions::engine. */
  std::string engine = "fast";
  /** See WorldOptions::num_threads. */
  int num_threads = 1;
  /** Simulated seconds per wall second, 0 for as fast as possible. */
  double pace = 1;
  /** Compute a tick only when every robot's command for the one before was received. */
  bool lock_step = false;
  bool ideal_sensors = false;
  /** Disturbances: name or list, see DisturbanceSet::find(). Empty: the robot as its model says,
   * with the noise of its sensors. */
  std::string disturbances;
  uint64_t seed = 1;
  /** Control period, ms: a multiple of the physics step of 2 ms, 2 to 100. -1: as the
   * disturbances say, or 10. */
  int tick_ms = -1;
  /** -1: as the disturbances say, or 1. */
  int command_latency_ticks = -1;
  /** Path of a Unix socket that serves the robot as a NAO V6 does (LoLA), instead of the bus;
   * empty: none. Needs lola.yaml in the model's folder, and a single robot. */
  std::string lola_socket{};
};

}  // namespace nao::sim
