#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nao::sim {

/** Options of nao-sim's command line. */
struct SimOptions {
  /** Scene: scenes/NAME.yaml of the data folder. */
  std::string scene = "soccer";
  /** Robot model: the name of its folder in robots/ of the data folder. */
  std::string model = "nao";
  /** Names of the robots, with which their channels begin; the first is at the origin. */
  std::vector<std::string> robots{"NAO"};
  /** Posture that the robots start in. */
  std::string posture{};
  /** Simulated seconds per wall second, 0 for as fast as possible. */
  double pace = 1;
  /** Compute a tick only when every robot's command for the one before was received. */
  bool lock_step = false;
  bool ideal_sensors = false;
  uint64_t seed = 1;
  /** Control period, ms: a multiple of the physics step of 2 ms, 2 to 100. */
  int tick_ms = 10;
  int command_latency_ticks = 1;
};

}  // namespace nao::sim
