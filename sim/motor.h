#pragma once

#include <algorithm>
#include <cmath>

#include "robot_model/robot_model.h"
#include "sim/backlash.h"

namespace nao::sim {

/** Mechanical stops of a joint: spring, N m/rad, and damper, N m s/rad. Assumed: 5 N m, the peak of
 * the NAO's leg motors, bend a stop by a third of a degree. */
inline constexpr double kStopStiffness = 1000;
inline constexpr double kStopDamping = 5;

/** A motor with gear and position servo, all quantities at the joint, and the plan of one step.
 *
 * **Law.** The servo demands u = kp (target - angle) - kd * speed, and the motor driver clips it to
 * +-limit. Back-EMF reduces the torque by limit / no_load_velocity * speed: the torque-speed line
 * of a DC motor at a fixed voltage, from `limit` at standstill to 0 at no-load speed. A current
 * limit keeps the torque of a braking motor within +-limit as well. `limit` is stiffness times the
 * peak torque; the peak falls to the continuous torque as the winding heats up. Viscous friction
 * and the rotor's reflected inertia (armature) add to the joint; dry friction is a constraint.
 *
 * **Time step.** Damping terms are implicit, so that no servo gain is unstable, see Plan. The
 * clipping is left to the solver, as bounds (JointRow). */
struct Drive {
  Motor motor;
  /** The servo's own gains; those of `motor` are these or the commanded ones. */
  double own_stiffness_gain = 0;
  double own_damping_gain = 0;
  /** What the servo makes of a gain, own or commanded: 1 as in the model. */
  double stiffness_ratio = 1;
  double damping_ratio = 1;
  /** Degree of freedom of the joint, or -1 for an opening (of a hand), which moves no body. */
  int dof = -1;
  /** Range of the joint, rad, and its largest speed, rad/s. */
  double lower = 0;
  double upper = 0;
  double max_velocity = 0;
  /** What the encoder, on the motor's side, reads at the motor's angle 0, rad. */
  double zero = 0;
  Backlash gear;

  /** Angle of an opening (other angles are in TreeState). */
  double opening = 0;
  /** Mean of the squared torque over the winding's time constant, in units of the squared
   * continuous torque: at 1 the motor gives only its continuous torque. */
  double heat = 0;

  /** Torques in a step as functions of the joint's speed v' at its end, N m, and N m s/rad:
   * servo u = demand - slope * v', back-EMF = emf + line * v', viscous friction = drag +
   * viscosity * v'. */
  struct Plan {
    double limit = 0;
    double demand = 0;
    double slope = 0;
    double emf = 0;
    double line = 0;
    double drag = 0;
    double viscosity = 0;
  };
  Plan plan;
  /** Speed at the end of this step, rad/s, of a motor that is free of its link in it. */
  double planned_free_velocity = 0;

  /** A row in the solver. */
  struct Row {
    /** Index in this step; -1 if absent. */
    int index = -1;
    /** Impulse of the last step, N m s: the start value. */
    double impulse = 0;
    /** Whether a torque bound includes back-EMF, since the motor brakes. */
    bool is_braking = false;
  };
  Row stop;
  Row friction;
  Row upper_bound;
  Row lower_bound;

  /** Time constant of the winding's temperature, s. Assumed: tens of seconds are usual for motors
   * of 20 mm. */
  static constexpr double kHeatTime = 30;
  /** Heat at which the peak torque begins to fall, and the range over which it falls to the
   * continuous torque. Assumed. */
  static constexpr double kWarmHeat = 0.8;
  static constexpr double kDeratingRange = 0.2;
  /** Largest (angular frequency * h)^2 of servo spring and rotor for which the spring is taken
   * explicitly: explicit integration is stable up to 4; at 0.3 a step is less than a tenth of a
   * period. Chosen. */
  static constexpr double kMaxExplicitSpring = 0.3;

  /** Largest torque at this heat, N m. */
  double torque_available() const {
    const double continuous = std::min(motor.continuous_torque, motor.peak_torque);
    const double derating = std::clamp((heat - kWarmHeat) / kDeratingRange, 0.0, 1.0);
    return motor.peak_torque + derating * (continuous - motor.peak_torque);
  }

  /** Whether the servo's spring acts from the angle at the start of a step of h seconds (leapfrog).
   * That adds no damping of its own, but needs a rotor that is heavy for the spring. Otherwise the
   * spring acts from the angle at the step's end, which is stable at any stiffness. */
  bool has_explicit_spring(double h) const {
    return motor.damping_gain > 0 &&
           h * h * motor.stiffness_gain <= kMaxExplicitSpring * motor.reflected_inertia;
  }

  /** Weight of the speed at the step's end in the speed that damping acts on, 0.5 to 1; the rest is
   * the speed at its start. 0.5 is of second order in h (trapezoidal rule). A damper that would
   * more than stop the rotor within the step has the weight that just stops it.
   * @param damping  Total damping of all dampers on the joint, N m s/rad. */
  double end_weight(double h, double damping) const {
    const double decay = h * damping;
    return decay > 2 * motor.reflected_inertia ? 1 - motor.reflected_inertia / decay : 0.5;
  }

  /** Plans a step of h seconds. @param stiffness  0 to 1. @param error  Target minus angle, rad.
   * @param speed  At the step's start, rad/s. */
  void plan_step(double h, double stiffness, double error, double speed) {
    const bool is_on = stiffness > 0;
    const double damping = is_on ? motor.damping_gain : 0;
    plan.limit = stiffness * torque_available();
    const double full_line = plan.limit / motor.no_load_velocity;
    const double end = end_weight(h, damping + full_line + motor.viscous_friction);
    const double past = (1 - end) * speed;
    plan.demand = (is_on ? motor.stiffness_gain * error : 0) - damping * past;
    plan.slope = end * damping + (is_on && !has_explicit_spring(h) ? h * motor.stiffness_gain : 0);
    plan.line = end * full_line;
    plan.emf = full_line * past;
    plan.viscosity = end * motor.viscous_friction;
    plan.drag = motor.viscous_friction * past;
  }

  /** Speed of the motor at the end of the planned step, with the link free of it, rad/s.
   * @param speed  At its start, rad/s. @param torque  Receives the motor's torque, N m. */
  double free_velocity(double h, double speed, double& torque) const {
    const double inertia = motor.reflected_inertia;
    double damping = plan.slope + plan.line + plan.viscosity;
    double velocity =
        (inertia * speed + h * (plan.demand - plan.emf - plan.drag)) / (inertia + h * damping);
    double demand = plan.demand - plan.slope * velocity;
    if (std::abs(demand) > plan.limit) {
      demand = std::copysign(plan.limit, demand);
      damping = plan.line + plan.viscosity;
      velocity = (inertia * speed + h * (demand - plan.emf - plan.drag)) / (inertia + h * damping);
    }
    // Applies dry friction, which slows the motor down and holds it.
    const double held = h * motor.dry_friction / (inertia + h * damping);
    velocity = std::copysign(std::max(0.0, std::abs(velocity) - held), velocity);
    torque = demand - plan.emf - plan.line * velocity;
    return velocity;
  }

  /** Heats or cools the winding: a first-order lag of the squared torque.
   * @param torque  Mean over `period` seconds, N m. */
  void warm_up(double torque, double period) {
    const double load = torque / motor.continuous_torque;
    heat += (load * load - heat) * period / kHeatTime;
  }
};

}  // namespace nao::sim
