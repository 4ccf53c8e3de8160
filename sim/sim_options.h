#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao::sim {

/** What nao-sim's command line says. */
struct SimOptions {
  /** Scene: scenes/NAME.yaml of the data folder. */
  std::string scene = "soccer";
  /** Robot's folder in robots/ of the data folder. */
  std::string model = "nao";
  /** Names of the robots, which their channels begin with; the first stands at the origin. */
  std::vector<std::string> robots{"NAO"};
  /** Posture that the robots start in. */
  std::string posture = "StandInit";
  /** Simulated seconds per wall second, 0 for as fast as possible. */
  double pace = 1;
  /** Compute a tick only when every robot's command for the one before has come. */
  bool lock_step = false;
  bool ideal_sensors = false;
  uint64_t seed = 1;
  int command_latency_ticks = 1;
};

}  // namespace nao::sim
