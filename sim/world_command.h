#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace nao::sim {

/** A change of the simulated world, read from world_command_t, which describes every field. */
struct WorldCommand {
  std::string source;
  int64_t id = 0;
  /** "pause", "place-robot", ... */
  std::string name;
  int64_t num_ticks = 0;
  double pace = 0;
  std::string robot{};
  std::string posture{};
  std::string model{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /** w, x, y, z. */
  Eigen::Vector4d orientation = Eigen::Vector4d::Zero();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::string link{};
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

/** Result of a world command. */
struct WorldCommandOutcome {
  std::string source;
  int64_t id = 0;
  /** Why it was rejected, as a sentence; empty if it was executed. */
  std::string error;
};

}  // namespace nao::sim
