#pragma once

#include <cmath>

namespace nao::sim {

/** Play of a gear between motor and link, seen at the joint.
 *
 * The gear is engaged on one flank, where motor and link move as one, or free, where each moves
 * alone. An engaged flank can only push: when it would have to pull, the gear is free from the next
 * step on. A free gear whose play is used up engages; motor and link then share their momentum in
 * the step that follows (an impact without rebound). */
struct Backlash {
  /** Half of the total play, rad. 0: motor and link always move as one. */
  double half_play = 0;
  /** Motor's angle minus link's, rad, within +-half_play. */
  double offset = 0;
  /** +1: the motor pushes the link to greater angles; -1: to smaller ones; 0: free. */
  int flank = 0;
  /** Motor's speed, rad/s. */
  double motor_velocity = 0;

  bool has_play() const { return half_play > 0; }
  bool is_engaged() const { return !has_play() || flank != 0; }

  /** At rest in the middle of the play. */
  void reset() {
    offset = 0;
    flank = 0;
    motor_velocity = 0;
  }
  /** Ends a step in which the gear was engaged.
   * @param velocity  Velocity of motor and link, rad/s. @param torque  From motor to link, N m. */
  void end_engaged_step(double velocity, double torque) {
    motor_velocity = velocity;
    if (flank * torque < 0) flank = 0;
  }
  /** Ends a step of h seconds in which the gear was free. @param link_velocity  rad/s. */
  void end_free_step(double h, double new_motor_velocity, double link_velocity) {
    motor_velocity = new_motor_velocity;
    offset += h * (motor_velocity - link_velocity);
    if (std::abs(offset) < half_play) return;
    flank = offset > 0 ? 1 : -1;
    offset = flank * half_play;
  }
};

}  // namespace nao::sim
