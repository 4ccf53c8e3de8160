#pragma once

#include <optional>

#include "daemons/motion/transitions/transition_graph.h"
#include "daemons/motion/walk/gait.h"

namespace nao::motion {

/** Everything about the motion core that may be tuned. */
struct MotionOptions {
  /** Silence of the sensors after which there is no robot, s. */
  double sensor_timeout = 0.5;
  /** Largest acceleration of a joint target, rad/s^2: reaches a leg joint's greatest speed in 0.2
   * s.
   */
  double max_acceleration = 30;
  /** The same for changes of joints that bear no weight (head and arms), which may begin with it at
   * once: the head's motor turns the head by 500 rad/s^2 with its continuous torque. */
  double free_acceleration = 200;
  /** Speed of motions that nobody gave a speed for, such as the first stand, fraction. */
  double default_speed = 0.3;
  /** Greatest speed of leg joints in a change of posture, fraction of the motors' own. */
  double posture_leg_speed = 0.35;
  /** A posture counts as reached if every joint is this near, rad. */
  double posture_tolerance = 0.09;
  /** Torso tilted more than this lies, rad. */
  double lying_tilt = 1.0;
  /** Least force on a foot that carries weight, N. */
  double foot_contact_force = 3.0;
  /** Period of motion states while nothing changes, s. */
  double motion_state_period = 0.1;
  /** Gets up by itself after a fall, this long after it lies still, s. */
  bool gets_up = true;
  double get_up_delay = 0.02;
  /** How to walk; nothing: as the robot's gait.yaml says, if it has one. */
  std::optional<Gait> gait;
  /** Ways between states of the body; nothing: as the robot's transitions.yaml says. */
  std::optional<TransitionGraph> transitions;

  /** @throws ConfigError  naming the option that makes no sense. */
  void validate() const;
};

}  // namespace nao::motion
