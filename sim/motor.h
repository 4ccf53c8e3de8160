#pragma once

#include <algorithm>

#include "robot_model/robot_model.h"

namespace nao::sim {

/** Mechanical stops of a joint, N m/rad and N m s/rad: 5 N m bend them by a third of a degree.
 * Assumed. */
inline constexpr double kStopStiffness = 1000;
inline constexpr double kStopDamping = 5;

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

  // Plan of the present step: u = demand - slope * (speed at the end of the step), and back-EMF
  // takes off emf + line * (that speed).
  double limit = 0;
  double demand = 0;
  double slope = 0;
  double emf = 0;
  double line = 0;
  /** What viscous friction takes off, like back-EMF. */
  double drag = 0;
  double viscosity = 0;

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

  /** Whether the rotor alone is heavy enough for the servo's spring to be taken at the angle at the
   * start of a step of h seconds: it then gives no damping that is not the servo's (leapfrog). A
   * stiffer one is taken at the step's end, which is always stable. */
  bool has_slow_spring(double h) const {
    return motor.damping_gain > 0 &&
           h * h * motor.stiffness_gain <= kSlowSpring * motor.reflected_inertia;
  }

  /** Share of the speed at the step's end, 0.5 to 1, in the speed that damping acts on; the rest is
   * the speed at its start. Half and half is of second order; a damper that would more than stop
   * the rotor within the step takes so much more of the end that it just stops it.
   * @param damping  All dampers on the joint, N m s/rad. */
  double end_share(double h, double damping) const {
    const double decay = h * damping;
    return decay > 2 * motor.reflected_inertia ? 1 - motor.reflected_inertia / decay : 0.5;
  }

  /** Plans a step of h seconds. @param stiffness  0 to 1. @param error  Target less angle, rad.
   * @param speed  At the step's start, rad/s. */
  void plan(double h, double stiffness, double error, double speed) {
    const bool is_on = stiffness > 0;
    const double damping = is_on ? motor.damping_gain : 0;
    limit = stiffness * torque_available();
    const double full_line = limit / motor.no_load_velocity;
    const double end = end_share(h, damping + full_line + motor.viscous_friction);
    const double past = (1 - end) * speed;
    demand = (is_on ? motor.stiffness_gain * error : 0) - damping * past;
    slope = end * damping + (is_on && !has_slow_spring(h) ? h * motor.stiffness_gain : 0);
    line = end * full_line;
    emf = full_line * past;
    viscosity = end * motor.viscous_friction;
    drag = motor.viscous_friction * past;
  }

  void warm_up(double torque, double period) {
    const double load = torque / motor.continuous_torque;
    heat += (load * load - heat) * period / kHeatTime;
  }
};

}  // namespace nao::sim
