#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace nao {

/** Walk velocity: m/s ahead, m/s to the left, rad/s to the left. */
struct WalkVelocity {
  double vx = 0;
  double vy = 0;
  double wz = 0;
};

/** Goal relative to where the robot stands: m ahead, m to the left, rad to the left. */
struct RelativeGoal {
  double x = 0;
  double y = 0;
  double theta = 0;
};

struct PostureGoal {
  std::string posture;
  /** Fraction of the maximum speed, (0, 1]. */
  double speed = 0;
};

/** Changes of single joints relative to their present targets. */
struct JointChange {
  std::vector<std::string> joint_names;
  /** rad (hands: opening), same length as the names. */
  std::vector<double> change;
  /** Fraction of the maximum speed, (0, 1]. */
  double speed = 0;
  bool allow_tipping = false;
};

struct NamedAction {
  std::string action;
  /** Ball on the ground, m, ahead and to the left; strength (0, 1]. NaN: as the action says. */
  double ball_x = 0;
  double ball_y = 0;
  double strength = 0;
};

struct StopMotion {};

/** What nao-motion can be asked for. */
using MotionCommand =
    std::variant<WalkVelocity, RelativeGoal, PostureGoal, JointChange, NamedAction, StopMotion>;

/** A command with the name that its results will carry. */
struct NumberedCommand {
  /** Unique among the senders on the bus. */
  std::string source;
  /** Not 0, never reused by this source (except by the repetitions of the same command). */
  int64_t command_id = 0;
  MotionCommand command;
};

/** In words for a person: "posture Crouch", "walk". */
std::string describe(const MotionCommand& command);

}  // namespace nao
