#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/command.h"
#include "messages/mode.h"

namespace nao::motion {

/** A planned footstep: sole origin on the ground, m, and heading, rad, in the odometry frame. */
struct Footstep {
  bool is_left = false;
  Eigen::Vector2d position_in_odometry = Eigen::Vector2d::Zero();
  double heading_in_odometry = 0;
};

/** What the motion core is doing; see motion_state_t for every field. */
struct MotionState {
  int64_t utime = 0;
  Mode mode = Mode::kNoRobot;
  std::string posture;
  /** Nothing for motions without a command. */
  std::optional<CommandKind> command_kind;
  std::string command_name;
  std::string command_source;
  int64_t command_id = 0;
  double command_progress = std::numeric_limits<double>::quiet_NaN();
  /** Tries to get up so far in the motion that runs; a roll and what follows it are one. */
  int num_tries = 0;
  bool needs_help = false;
  double balance_margin = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d walk_velocity = Eigen::Vector3d::Zero();
  double stiffness = 0;
  /** Of the last refused command; none if there was none. */
  Reason last_refusal;
  std::vector<Footstep> footsteps;
};

}  // namespace nao::motion
