#pragma once

#include <vector>

#include "daemons/motion/robot_state.h"
#include "daemons/motion/walk/gait.h"
#include "kinematics/leg_kinematics.h"

namespace nao::motion {

/** Keeps a robot that is pushed while it stands on its feet.
 *
 * Ankles and hips turn with the torso's angular velocity: the ankles move the center of pressure to
 * the edge of the soles, and the hips turn the trunk against the fall, away from that edge. Below a
 * least rate only the servos hold the posture, so that sensor noise does not move the robot. */
class StandingBalance {
 public:
  /** @param gains, legs  Must outlive this. */
  StandingBalance(const Gait::Standing& gains, const LegKinematics& legs)
      : gains_(&gains), legs_(&legs) {}

  /** Whether a robot on its feet was pushed ahead or back so that it cannot come to rest without a
   * step. To the side it withstands more on both feet: the foot that would step outward carries it.
   */
  bool must_step(const RobotState& state) const;

  /** Adds the joint angles to the targets of a standing robot. @param position  rad, (num_motors).
   */
  void add_to(const RobotState& state, std::vector<double>& position) const;

 private:
  const Gait::Standing* gains_;
  const LegKinematics* legs_;
};

}  // namespace nao::motion
