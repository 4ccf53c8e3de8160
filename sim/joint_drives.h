#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/constraint_solver.h"
#include "sim/motor.h"
#include "sim/motor_targets.h"
#include "sim/tree.h"
#include "sim/tree_dynamics.h"
#include "sim/tree_integrator.h"
#include "sim/world_options.h"

namespace nao::sim {

/** Effect of a motor on its joint in a step of an engine that takes forces from the state at the
 * step's start. All except `dof` are 0 if the motor is free in its gear's play. */
struct JointForce {
  /** Our degree of freedom. */
  int dof = -1;
  /** N m. */
  double torque = 0;
  /** Reflected inertia of the rotor, kg m^2. */
  double inertia = 0;
  /** N m s/rad, and N m. */
  double viscous_friction = 0;
  double dry_friction = 0;
};

/** All motors of one robot: servo torques, and the joints' constraint rows (stops, dry friction,
 * torque bounds) in a step. Lists are in motor order. */
class JointDrives {
 public:
  /** @param tree  Must outlive this. */
  JointDrives(const RobotModel& model, const Tree& tree, const RobotOptions& options);

  /** True angles (hands: openings) and torques of the last step, (num_motors). */
  double position(int motor, const TreeState& state) const;
  /** What the motor's encoder would read without quantization: the motor's angle, on its side of
   * the gear's play, with the error of its zero, rad. */
  double encoder_position(int motor, const TreeState& state) const;
  const Eigen::VectorXd& torque() const { return torque_; }
  /** Whether the motor moves no body of the physics, only an opening. */
  bool is_opening(int motor) const { return drives_[motor].dof < 0; }
  /** Degree of freedom of a motor's joint; -1 for an opening. */
  int dof(int motor) const { return drives_[motor].dof; }
  double speed(int motor, const TreeState& state) const;
  /** Kinetic energy of the rotors and elastic energy of the joint stops, J. */
  double energy(const TreeState& state) const;

  /** Motors at rest at these angles, rad, (num_motors). */
  void place(const std::vector<double>& position);
  /** Sets the windings to ambient temperature. */
  void switch_on();

  // A step of h seconds, in this order.

  /** Plans the torques and adds them to the momentum. */
  void begin_step(double h, const MotorTargets& targets, TreeIntegrator& integrator);
  /** Adds the rows that the state at the step's start asks for.
   * @param first_dof  First dof of the robot in the solver's vector. */
  void add_rows(double h, const TreeState& state, const TreeDynamics& dynamics, int first_dof,
                ConstraintSolver& solver);
  /** Adds bounds for motors that exceed their torque at a velocity.
   * @param velocity  Velocity of the solver's present solution, (num_dofs). @return Whether there
   * were any.
   */
  bool add_missed_bounds(double h, const Eigen::VectorXd& velocity, const TreeDynamics& dynamics,
                         int first_dof, ConstraintSolver& solver);
  /** Reads the solution. @param velocity  At the step's end, (num_dofs). */
  void end_step(double h, const Eigen::VectorXd& velocity, const ConstraintSolver& solver);

  // A step of h seconds in an engine other than the fast one, in this order.

  /** Forces from a state; valid until the next call. */
  const std::vector<JointForce>& begin_explicit_step(double h, const MotorTargets& targets,
                                                     const TreeState& state);
  /** Moves the motors in their gears' play. @param state  At the step's end. */
  void end_explicit_step(double h, const TreeState& state);

  /** Heats the windings and moves the openings. @param torque_impulse  Torques integrated over the
   * tick, N m s, (num_motors). @param period  Length of the tick, s. */
  void end_tick(const Eigen::VectorXd& torque_impulse, const MotorTargets& targets, double period);

 private:
  /** The commanded gains, or the servos' own. */
  void set_gains(const MotorTargets& targets);
  /** Adds a row on one degree of freedom, with chain and entries, to be ended. @return null if the
   * solver's memory is used up. */
  JointRow* begin_row(int dof, const TreeDynamics& dynamics, int first_dof,
                      ConstraintSolver& solver);
  void plan_free_motor(double h, size_t motor);
  void end_gear_step(double h, double torque, double speed, Drive& drive) const;
  void add_friction_row(double h, Drive& drive, const TreeDynamics& dynamics, int first_dof,
                        ConstraintSolver& solver);
  void add_stop_row(double h, const TreeState& state, Drive& drive, const TreeDynamics& dynamics,
                    int first_dof, ConstraintSolver& solver);
  void add_torque_bound(double h, Drive& drive, bool is_upper, bool is_braking,
                        const TreeDynamics& dynamics, int first_dof, ConstraintSolver& solver);

  const Tree& tree_;
  std::vector<Drive> drives_;
  /** Whether a target has gains of its own. */
  bool has_commanded_gains_ = false;
  std::vector<JointForce> joint_forces_;
  /** Targets' positions in the last step, rad. */
  Eigen::VectorXd last_target_;
  /** N m. */
  Eigen::VectorXd torque_;
  /** For each dof, the last dof of its limb: among the dofs that it moves, the one that most dofs
   * move.
   */
  std::vector<int> end_of_limb_;
  /** The solver's chain of each last dof of a limb in this step, -1 if there is none. */
  std::vector<int> chain_of_limb_;
};

}  // namespace nao::sim
