#pragma once

#include <string>

namespace nao {
class CommandLine;
}

namespace nao::robot {

/** Options of nao-robot; its watchdog takes the same. */
struct RobotOptions {
  /** LoLA's socket. */
  std::string lola_socket = "/tmp/robocup";
  std::string model = "nao";
  bool lock_step = false;
  bool starts_itself = false;
  /** Descriptor to which the watchdog expects a byte every kHeartbeatPeriod; -1: none. */
  int heartbeat = -1;
};

/** s. Chosen: a tenth of the silence that the watchdog allows. */
inline constexpr double kHeartbeatPeriod = 0.02;

void add_robot_options(CommandLine& app, RobotOptions& options);

}  // namespace nao::robot
