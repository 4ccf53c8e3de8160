#include "sim/joint_drives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nao::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** A motor whose servo demands more than this fraction of its limit at the step's start gets a
 * torque bound at once; others when the solution turns out to exceed the limit. Chosen: rows cost
 * time, and a round of missed bounds costs more. */
constexpr double kBoundFraction = 0.8;
/** Fraction of the limit by which a torque may exceed it without a new round of the solver. */
constexpr double kBoundTolerance = 1e-3;
/** Distance from its stop, rad, within which a joint has the stop's row at any speed. Chosen: an
 * unneeded row only costs time. */
constexpr double kStopMargin = 0.01;
/** Time constant with which an opening follows its target, s. Assumed. */
constexpr double kOpeningTime = 0.1;

// The rows that a drive may have in a step, for loops over all of them.
std::array<Drive::Row*, 4> rows_of(Drive& drive) {
  return {&drive.stop, &drive.friction, &drive.upper_bound, &drive.lower_bound};
}

}  // namespace

JointDrives::JointDrives(const RobotModel& model, const Tree& tree, const RobotOptions& options)
    : tree_(tree) {
  const int num_motors = model.num_motors();
  for (int i = 0; i < num_motors; ++i) {
    Drive drive;
    drive.motor = model.motor(i);
    drive.motor.peak_torque *= options.torque_scale;
    drive.motor.continuous_torque *= options.torque_scale;
    const Joint& joint = model.motor_joint(i);
    drive.lower = joint.lower;
    drive.upper = joint.upper;
    drive.max_velocity = joint.max_velocity;
    const RobotErrors& errors = options.errors;
    if (errors.joint_zero.size() > 0) drive.zero = errors.joint_zero[i];
    if (errors.servo_stiffness.size() > 0) drive.stiffness_ratio = errors.servo_stiffness[i];
    if (errors.servo_damping.size() > 0) drive.damping_ratio = errors.servo_damping[i];
    drive.motor.stiffness_gain *= drive.stiffness_ratio;
    drive.motor.damping_gain *= drive.damping_ratio;
    drive.own_stiffness_gain = drive.motor.stiffness_gain;
    drive.own_damping_gain = drive.motor.damping_gain;
    if (errors.backlash.size() > 0) drive.gear.half_play = errors.backlash[i] / 2;
    // The joint's degree of freedom. A motor that no body of the tree belongs to opens a hand, and
    // keeps dof -1.
    for (int body = 1; body < tree_.num_bodies(); ++body) {
      if (tree_.bodies()[body].joint == model.motors()[i]) drive.dof = tree_.bodies()[body].dof;
    }
    drives_.push_back(drive);
  }
  last_target_ = Eigen::VectorXd::Zero(num_motors);
  torque_ = Eigen::VectorXd::Zero(num_motors);
  chain_of_limb_.assign(tree_.num_dofs(), -1);
  for (int dof = 0; dof < tree_.num_dofs(); ++dof) end_of_limb_.push_back(dof);
  // Descendants come after a dof: the first one found with the longest chain ends its limb.
  for (int dof = tree_.num_dofs() - 1; dof >= 0; --dof) {
    for (int below = dof + 1; below < tree_.num_dofs(); ++below) {
      const std::vector<int>& above = tree_.dof_ancestors(below);
      const bool is_below = std::binary_search(above.begin(), above.end(), dof);
      const size_t longest = tree_.dof_ancestors(end_of_limb_[dof]).size();
      if (is_below && above.size() > longest) end_of_limb_[dof] = below;
    }
  }
}

double JointDrives::position(int motor, const TreeState& state) const {
  const Drive& drive = drives_[motor];
  return drive.dof < 0 ? drive.opening : state.coordinate[drive.dof];
}

// What the robot's encoder reads, rad: the motor's side of the gear (link plus play) with the error
// of the joint's zero.
double JointDrives::encoder_position(int motor, const TreeState& state) const {
  const Drive& drive = drives_[motor];
  if (drive.dof < 0) return drive.opening;
  return state.coordinate[drive.dof] + drive.gear.offset + drive.zero;
}

double JointDrives::speed(int motor, const TreeState& state) const {
  const Drive& drive = drives_[motor];
  return drive.dof < 0 ? 0 : state.velocity[drive.dof];
}

// Kinetic energy of the rotors and elastic energy of the stops, J; the tree has the rest.
double JointDrives::energy(const TreeState& state) const {
  double sum = 0;
  for (const Drive& drive : drives_) {
    if (drive.dof < 0) continue;
    const double speed =
        drive.gear.has_play() ? drive.gear.motor_velocity : state.velocity[drive.dof];
    const double angle = state.coordinate[drive.dof];
    const double bent = std::max({0.0, drive.lower - angle, angle - drive.upper});
    sum += 0.5 * drive.motor.reflected_inertia * speed * speed + 0.5 * kStopStiffness * bent * bent;
  }
  return sum;
}

// At rest at these positions, in the middle of the play, without impulses of the last step.
void JointDrives::place(const std::vector<double>& position) {
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    drive.opening = position[i];
    drive.gear.reset();
    for (Drive::Row* row : rows_of(drive)) row->impulse = 0;
    last_target_[static_cast<long>(i)] = position[i];
  }
  torque_.setZero();
}

void JointDrives::switch_on() {
  for (Drive& drive : drives_) drive.heat = 0;
}

void JointDrives::set_gains(const MotorTargets& targets) {
  if (!has_commanded_gains_ && targets.kp.size() == 0) return;
  has_commanded_gains_ = targets.kp.size() > 0;
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    drive.motor.stiffness_gain = drive.own_stiffness_gain;
    drive.motor.damping_gain = drive.own_damping_gain;
    if (!has_commanded_gains_) continue;
    const auto k = static_cast<long>(i);
    if (!std::isnan(targets.kp[k]))
      drive.motor.stiffness_gain = drive.stiffness_ratio * targets.kp[k];
    if (!std::isnan(targets.kd[k])) drive.motor.damping_gain = drive.damping_ratio * targets.kd[k];
  }
}

void JointDrives::begin_step(double h, const MotorTargets& targets, TreeIntegrator& integrator) {
  set_gains(targets);
  const TreeState& state = integrator.state();
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0) continue;
    const auto k = static_cast<long>(i);
    const Backlash& gear = drive.gear;
    const double speed = gear.has_play() ? gear.motor_velocity : state.velocity[drive.dof];
    // Leapfrog: a velocity belongs to the middle between two steps, so that half of this step's
    // torque acts before a target that is new in it.
    const double target = (last_target_[k] + targets.position[k]) / 2;
    // The servo controls what its encoder reads, errors included.
    const double measured = state.coordinate[drive.dof] + gear.offset + drive.zero;
    drive.plan_step(h, targets.stiffness[k], target - measured, speed);
    // No row of the last step is left: index -1 until one is added below.
    for (Drive::Row* row : rows_of(drive)) row->index = -1;
    if (!gear.is_engaged()) {
      plan_free_motor(h, i);
      continue;
    }
    // The rotor joins its link: (M + D) u' = M u + J speed + h (torques), where the parts of the
    // torques that depend on u' are in D, see TreeIntegrator. The term J * speed is the rotor's
    // momentum, which with play differs from that of the link's speed.
    const double inertia = drive.motor.reflected_inertia;
    integrator.add_joint_impulse(
        drive.dof, inertia * speed + h * (drive.plan.demand - drive.plan.emf - drive.plan.drag),
        inertia + h * (drive.plan.slope + drive.plan.line + drive.plan.viscosity));
  }
  last_target_ = targets.position;
  std::fill(chain_of_limb_.begin(), chain_of_limb_.end(), -1);
}

void JointDrives::plan_free_motor(double h, size_t motor) {
  Drive& drive = drives_[motor];
  drive.planned_free_velocity =
      drive.free_velocity(h, drive.gear.motor_velocity, torque_[static_cast<long>(motor)]);
}

// A row L^-T e_dof: a unit velocity of the joint. Rows of a limb's joints share the chain of its
// last joint, of which each acts on the first dofs.
JointRow* JointDrives::begin_row(int dof, const TreeDynamics& dynamics, int first_dof,
                                 ConstraintSolver& solver) {
  const int end = end_of_limb_[dof];
  int& chain = chain_of_limb_[end];
  if (chain < 0) {
    const std::vector<int>& dofs = tree_.bodies()[tree_.body_of_dof(end)].chain;
    chain = solver.add_chain(dofs.data(), static_cast<int>(dofs.size()), first_dof);
    if (chain < 0) return nullptr;
  }
  JointRow* row = solver.begin_row();
  if (row == nullptr) return nullptr;
  row->chain = chain;
  row->num_pairs = num_pairs(static_cast<int>(tree_.dof_ancestors(dof).size()) + 1);
  row->entries = dynamics.inverse_row(dof);
  row->diagonal = dynamics.inverse_square(dof);
  return row;
}

void JointDrives::add_friction_row(double h, Drive& drive, const TreeDynamics& dynamics,
                                   int first_dof, ConstraintSolver& solver) {
  // Holds the joint still with an impulse up to h times the dry friction.
  // bias = softness = 0: within its bounds the impulse brings the joint's speed to exactly 0.
  JointRow* row = begin_row(drive.dof, dynamics, first_dof, solver);
  if (row == nullptr) return;
  row->upper = h * drive.motor.dry_friction;
  row->lower = -row->upper;
  row->impulse = drive.friction.impulse;
  drive.friction.index = solver.end_row();
}

void JointDrives::add_stop_row(double h, const TreeState& state, Drive& drive,
                               const TreeDynamics& dynamics, int first_dof,
                               ConstraintSolver& solver) {
  const double angle = state.coordinate[drive.dof];
  const double speed = state.velocity[drive.dof];
  // Positive inside the range; the nearer stop counts. Only one can be reached in a step.
  const double to_lower = angle - drive.lower;
  const double to_upper = drive.upper - angle;
  const bool is_low = to_lower < to_upper;
  const double distance = is_low ? to_lower : to_upper;
  const double approach_speed = is_low ? -speed : speed;
  // 2 h: the speed may double within the step. Written so that NaN adds no row.
  if (!(distance < kStopMargin + 2 * h * approach_speed)) {
    drive.stop.impulse = 0;
    return;
  }
  JointRow* row = begin_row(drive.dof, dynamics, first_dof, solver);
  if (row == nullptr) return;
  // Spring and damper, implicit; the same law as a contact's, see ContactAssembler.
  const double strength = h * kStopStiffness + kStopDamping;
  row->apply = row->measure = is_low ? 1 : -1;
  row->softness = 1 / (h * strength);
  row->bias = distance > 0 ? distance / h : kStopStiffness * distance / strength;
  row->upper = kInfinity;
  row->impulse = drive.stop.impulse;
  drive.stop.index = solver.end_row();
}

void JointDrives::add_torque_bound(double h, Drive& drive, bool is_upper, bool is_braking,
                                   const TreeDynamics& dynamics, int first_dof,
                                   ConstraintSolver& solver) {
  Drive::Row& bound = is_upper ? drive.upper_bound : drive.lower_bound;
  // A bound that changes from driving to braking keeps its place and impulse.
  const bool is_new = bound.index < 0;
  JointRow* row =
      is_new ? begin_row(drive.dof, dynamics, first_dof, solver) : &solver.row(bound.index);
  // Without memory the bound is missing in this step, and the motor may exceed its limit in it.
  if (row == nullptr) return;
  // The bounded torque is demand - slope * v': the servo's demand u, less back-EMF when braking.
  // The row's impulse p >= 0 takes from it what exceeds the limit: demand - slope * v' - p / h =
  // limit  =>  v' + p / (h slope) + (limit - demand) / slope = 0, and the mirror image for the
  // lower bound.
  // emf and line are the two parts of the back-EMF, emf + line * v', see Drive::Plan.
  const double slope = drive.plan.slope + (is_braking ? drive.plan.line : 0);
  const double demand = drive.plan.demand - (is_braking ? drive.plan.emf : 0);
  row->apply = is_upper ? -1 : 1;
  row->measure = is_upper ? 1 : -1;
  row->softness = 1 / (h * slope);
  row->bias = (is_upper ? drive.plan.limit - demand : drive.plan.limit + demand) / slope;
  row->upper = kInfinity;
  if (is_new) {
    row->impulse = bound.impulse;
    bound.index = solver.end_row();
  } else {
    ConstraintSolver::complete(*row);
  }
  bound.is_braking = is_braking;
}

void JointDrives::add_rows(double h, const TreeState& state, const TreeDynamics& dynamics,
                           int first_dof, ConstraintSolver& solver) {
  for (Drive& drive : drives_) {
    if (drive.dof < 0) continue;
    const bool is_engaged = drive.gear.is_engaged();
    if (is_engaged && drive.motor.dry_friction > 0) {
      add_friction_row(h, drive, dynamics, first_dof, solver);
    }
    add_stop_row(h, state, drive, dynamics, first_dof, solver);
    // Without a slope the servo is off, or has no gain at all.
    if (!is_engaged || !(drive.plan.slope > 0)) continue;
    const double speed = state.velocity[drive.dof];
    // Predicted with the speed at the start of the step. A bound that was active in the last step
    // is kept as well: its start value is good.
    const double demanded = drive.plan.demand - drive.plan.slope * speed;
    const double threshold = kBoundFraction * drive.plan.limit;
    if (demanded > threshold || drive.upper_bound.impulse > 0) {
      add_torque_bound(h, drive, true, speed < 0, dynamics, first_dof, solver);
    }
    if (demanded < -threshold || drive.lower_bound.impulse > 0) {
      add_torque_bound(h, drive, false, speed > 0, dynamics, first_dof, solver);
    }
  }
}

// Adds bounds that the solved step violates and that have no row yet, and returns whether there
// were any; the stepper then solves again.
bool JointDrives::add_missed_bounds(double h, const Eigen::VectorXd& velocity,
                                    const TreeDynamics& dynamics, int first_dof,
                                    ConstraintSolver& solver) {
  bool has_changed = false;
  const auto impulse_of = [&](const Drive::Row& row) {
    return row.index < 0 ? 0.0 : solver.rows()[row.index].impulse;
  };
  for (Drive& drive : drives_) {
    if (drive.dof < 0 || drive.plan.slope == 0 || !drive.gear.is_engaged()) continue;
    const double speed = velocity[drive.dof];
    // The servo's torque in the solution so far, N m, including what the bounds take from it.
    const double driven = drive.plan.demand - drive.plan.slope * speed +
                          (impulse_of(drive.lower_bound) - impulse_of(drive.upper_bound)) / h;
    const double allowed = drive.plan.limit * (1 + kBoundTolerance);
    const double back_emf = drive.plan.emf + drive.plan.line * speed;
    for (const bool is_upper : {true, false}) {
      // A motor brakes where back-EMF acts in the direction of the bound.
      // A driving motor's servo torque is bounded, a braking one's servo torque less back-EMF.
      const bool is_braking = is_upper ? back_emf < 0 : back_emf > 0;
      const double bounded = driven - (is_braking ? back_emf : 0);
      if (is_upper ? bounded <= allowed : bounded >= -allowed) continue;
      Drive::Row& bound = is_upper ? drive.upper_bound : drive.lower_bound;
      // With this bound, the excess is the solver's tolerance.
      if (bound.index >= 0 && bound.is_braking == is_braking) continue;
      // Rows that are added after the warm start begin without an impulse.
      if (bound.index < 0) bound.impulse = 0;
      add_torque_bound(h, drive, is_upper, is_braking, dynamics, first_dof, solver);
      has_changed = true;
    }
  }
  return has_changed;
}

void JointDrives::end_step(double h, const Eigen::VectorXd& velocity,
                           const ConstraintSolver& solver) {
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    if (drive.dof < 0) continue;
    const double speed = velocity[drive.dof];
    // Impulses for the next step's warm start; a row that is absent has none.
    for (Drive::Row* row : rows_of(drive)) {
      row->impulse = row->index < 0 ? 0 : solver.rows()[row->index].impulse;
    }
    // The torque that the motor gave, at the joint: before friction and the rotor's acceleration. A
    // free motor's was computed by plan_free_motor().
    double& torque = torque_[static_cast<long>(i)];
    if (drive.gear.is_engaged()) {
      torque = drive.plan.demand - drive.plan.emf - (drive.plan.slope + drive.plan.line) * speed +
               (drive.lower_bound.impulse - drive.upper_bound.impulse) / h;
    }
    if (drive.gear.has_play()) end_gear_step(h, torque, speed, drive);
  }
}

void JointDrives::end_gear_step(double h, double torque, double speed, Drive& drive) const {
  Backlash& gear = drive.gear;
  if (!gear.is_engaged()) {
    gear.end_free_step(h, drive.planned_free_velocity, speed);
    return;
  }
  // What remains of the motor's torque after its friction and the acceleration of its rotor.
  const double friction =
      drive.plan.drag + drive.plan.viscosity * speed - drive.friction.impulse / h;
  const double acceleration = (speed - gear.motor_velocity) / h;
  gear.end_engaged_step(speed, torque - friction - drive.motor.reflected_inertia * acceleration);
}

// Once in a control tick: winding temperatures from the mean torque of the tick, and openings of
// hands, which follow their target as a first-order lag with limited speed (kinematic, no mass).
void JointDrives::end_tick(const Eigen::VectorXd& torque_impulse, const MotorTargets& targets,
                           double period) {
  for (size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    const auto k = static_cast<long>(i);
    if (drive.dof >= 0) {
      drive.warm_up(torque_impulse[k] / period, period);
    } else if (targets.stiffness[k] > 0) {
      const double error =
          std::clamp(targets.position[k], drive.lower, drive.upper) - drive.opening;
      const double speed =
          std::clamp(error / kOpeningTime, -drive.max_velocity, drive.max_velocity);
      drive.opening += speed * period;
    }
  }
}

}  // namespace nao::sim
