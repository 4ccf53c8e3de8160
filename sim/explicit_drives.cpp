// Servos and motors for engines that take forces from the state at a step's start.

#include <algorithm>
#include <cmath>

#include "sim/joint_drives.h"

namespace nao::sim {
namespace {

/** Speed below which the sign of dry friction is smoothed, rad/s. Chosen: a tenth of the slowest
 * joint motion that is visible. */
constexpr double kStill = 0.01;

}  // namespace

const std::vector<JointForce>& JointDrives::begin_explicit_step(double h,
                                                                const MotorTargets& targets,
                                                                const TreeState& state) {
  set_gains(targets);
  joint_forces_.clear();
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0) continue;
    const auto k = static_cast<long>(i);
    const Backlash& gear = drive.gear;
    // The servo measures the motor's side of the gear; with play that speed differs from the
    // link's.
    const double link_speed = state.velocity[drive.dof];
    const double speed = gear.has_play() ? gear.motor_velocity : link_speed;
    // Mean of the last and the new target, as in JointDrives::begin_step(), so that all engines see
    // the same commands.
    const double target = (last_target_[k] + targets.position[k]) / 2;
    const double error = target - (state.coordinate[drive.dof] + gear.offset + drive.zero);
    JointForce force;
    force.dof = drive.dof;
    // Within the play the motor exerts no torque on the link and moves alone.
    if (!gear.is_engaged()) {
      drive.plan_step(h, targets.stiffness[k], error, speed);
      plan_free_motor(h, i);
      joint_forces_.push_back(force);
      continue;
    }
    const Motor& motor = drive.motor;
    // The laws of Drive: PD demand clipped to the limit, then the back-EMF line, then clipped again
    // (a braking motor's current limit). All from the speed at the start of the step.
    const double limit = targets.stiffness[k] * drive.torque_available();
    const double demand =
        limit > 0
            ? std::clamp(motor.stiffness_gain * error - motor.damping_gain * speed, -limit, limit)
            : 0;
    torque_[k] = std::clamp(demand - limit / motor.no_load_velocity * speed, -limit, limit);
    // The engine moves link and rotor with the link's speed: a rotor that has just engaged brings
    // the rest of its momentum.
    force.torque = torque_[k] + motor.reflected_inertia * (speed - link_speed) / h;
    force.inertia = motor.reflected_inertia;
    force.viscous_friction = motor.viscous_friction;
    force.dry_friction = motor.dry_friction;
    joint_forces_.push_back(force);
  }
  last_target_ = targets.position;
  return joint_forces_;
}

void JointDrives::end_explicit_step(double h, const TreeState& state) {
  // The play opens by the torque that passed the gear; begin_explicit_step() has applied all else.
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0 || !drive.gear.has_play()) continue;
    const double speed = state.velocity[drive.dof];
    // Dry friction of the step from the sign of the speed, blurred by tanh: the engine does not
    // report the friction that it applied.
    drive.friction.impulse = -h * drive.motor.dry_friction * std::tanh(speed / kStill);
    drive.plan.drag = 0;
    drive.plan.viscosity = drive.motor.viscous_friction;
    end_gear_step(h, torque_[static_cast<long>(i)], speed, drive);
  }
}

}  // namespace nao::sim
