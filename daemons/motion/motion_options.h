#pragma once

#include <optional>
#include <string>

#include "calibration/calibration.h"
#include "daemons/motion/transitions/transition_graph.h"
#include "daemons/motion/walk/gait.h"

namespace nao::motion {

/** See MotionOptions::policy. */
inline constexpr const char* kNoPolicy = "none";

/** Options of the motion core. */
struct MotionOptions {
  /** Time without sensor data after which there is no robot, s. */
  double sensor_timeout = 0.5;
  /** Greatest acceleration of a joint target, rad/s^2. Chosen: a leg joint reaches its maximum
   * speed of about 6 rad/s in 0.2 s. */
  double max_acceleration = 30;
  /** The same for joints that do not carry the body (head and arms), which may start with it at
   * once. The head's motor accelerates the head by 500 rad/s^2 with its continuous torque. */
  double free_acceleration = 200;
  /** Speed of the robot's own motions, such as the first stand, fraction of the maximum. */
  double default_speed = 0.3;
  /** Greatest speed of leg joints between postures, fraction of the motors' maximum. */
  double posture_leg_speed = 0.35;
  /** Greatest deviation of every joint in a posture that was reached, rad (5 degrees): the servos'
   * tracking error under load. */
  double posture_tolerance = 0.09;
  /** The same for a lying posture, rad (8 degrees): limbs lie on the floor, whose friction weak
   * wrists do not overcome. */
  double lying_posture_tolerance = 0.14;
  double tolerance_of(const Posture& posture) const {
    return posture.is_lying() ? lying_posture_tolerance : posture_tolerance;
  }
  /** Tilt of the torso above which the robot lies, rad. */
  double lying_tilt = 1.0;
  /** Period of motion states while nothing changes, s. */
  double motion_state_period = 0.1;
  /** Gets up by itself after a fall. */
  bool gets_up = true;
  /** Time for which it lies still before it gets up, s. */
  double get_up_delay = 0.02;
  /** Gait; nothing: as in the robot's gait.yaml, if it has one. */
  std::optional<Gait> gait;
  /** Transitions between states of the body; nothing: as in the robot's transitions.yaml. */
  std::optional<TransitionGraph> transitions;
  /** Policy that walks instead of the gait, or gets up; empty: a robot that has one gets up by it;
   * kNoPolicy: it does not. */
  std::string policy;
  /** How the robot differs from its model; nothing: not at all. */
  std::optional<Calibration> calibration;

  /** @throws ConfigError  naming the option that is out of its range. */
  void validate() const;
};

}  // namespace nao::motion
