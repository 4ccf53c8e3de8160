#pragma once

#include <algorithm>

#include "common/robot_model.h"

namespace nao::sim {

/** A motor with gear and position servo, at the joint.
 *
 * The servo asks for u = gain * (target - angle) - damping * speed, which the motor driver clips
 * to +-limit; back-EMF takes off limit / no_load_velocity * speed, so that the torque follows the
 * motor's line and is 0 at no-load speed; a current limit keeps a braking torque within the limit
 * too. `limit` is stiffness times the peak torque, and falls to the continuous torque as the motor
 * warms up. */
struct Drive {
  Motor motor;
  /** Dof of the joint, or -1 for an opening, which moves no body. */
  int dof = -1;
  /** Range of the joint, rad. */
  double lower = 0;
  double upper = 0;
  double max_velocity = 0;

  /** Angle of an opening (others: in TreeState). */
  double opening = 0;
  /** Mean square of the torque over the winding's time constant, in units of the continuous
   * torque's square: 1 is as hot as the motor may get. */
  double heat = 0;

  // Plan of the present step: u = demand - slope * (speed at the end of the step).
  double limit = 0;
  double demand = 0;
  double slope = 0;
  /** N m s/rad: limit over no-load speed. */
  double line = 0;

  // Rows in the solver, -1 if absent, and their last impulses.
  int stop_row = -1;
  int friction_row = -1;
  int upper_row = -1;
  int lower_row = -1;
  /** Whether those rows are the bound of a braking motor. */
  bool is_upper_braking = false;
  bool is_lower_braking = false;
  double stop_impulse = 0;
  double friction_impulse = 0;
  double upper_impulse = 0;
  double lower_impulse = 0;

  /** Time constant of the winding's temperature, s: assumed, some tens of seconds are usual for
   * motors of 20 mm. */
  static constexpr double kHeatTime = 30;

  /** Square of a servo's frequency times the step that counts as slow: an eighth of a turn at most;
   * explicit integration is stable up to 4. */
  static constexpr double kSlowSpring = 0.3;

  /** Greatest torque that a motor of this heat may give, N m. */
  double torque_available() const {
    const double continuous = std::min(motor.continuous_torque, motor.peak_torque);
    const double tired = std::clamp((heat - 0.8) / 0.2, 0.0, 1.0);
    return motor.peak_torque + tired * (continuous - motor.peak_torque);
  }

  /** How much less the servo asks for, N m, per speed at the end of a step of h seconds: its
   * damping, and where its spring is too stiff for the step also the angle that the joint will
   * turn. Where the rotor alone is heavy enough for the spring, the angle at the step's start gives
   * no damping that is not the servo's, and half the error (leapfrog). */
  double servo_slope(double h) const {
    const double spring = h * motor.stiffness_gain;
    const bool is_slow = h * spring <= kSlowSpring * motor.reflected_inertia;
    return motor.damping_gain + (is_slow && motor.damping_gain > 0 ? 0 : spring);
  }

  void warm_up(double torque, double period) {
    const double load = torque / motor.continuous_torque;
    heat += (load * load - heat) * period / kHeatTime;
  }
};

}  // namespace nao::sim
