#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "messages/command.h"
#include "messages/mode.h"
#include "messages/reason.h"

namespace nao::motion {

/** A planned footstep: sole origin on the ground, m, and heading, rad, in the odometry frame. */
struct Footstep {
  bool is_left = false;
  Eigen::Vector2d position_in_odometry = Eigen::Vector2d::Zero();
  double heading_in_odometry = 0;
};

/** State of the motion core; motion_state_t documents every field of the same name. */
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
  /** Attempts to get up in the running motion; a roll and the get-up motion after it count as one.
   */
  int num_tries = 0;
  bool needs_help = false;
  /** Index of the keyframe to which a taught motion moves, or at which it pauses; -1: none. */
  int keyframe = -1;
  double balance_margin = std::numeric_limits<double>::quiet_NaN();
  /** m/s forward, m/s to the left, rad/s. */
  Eigen::Vector3d walk_velocity = Eigen::Vector3d::Zero();
  double stiffness = 0;
  /** Why the last refused command was refused; none if no command was refused. */
  Reason last_refusal;
  std::vector<Footstep> footsteps;
};

}  // namespace nao::motion
