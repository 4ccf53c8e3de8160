#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/collision_model.h"
#include "sim/constraint_solver.h"
#include "sim/joint_drives.h"
#include "sim/motor_targets.h"
#include "sim/sensor_accumulator.h"
#include "sim/sensors.h"
#include "sim/tree.h"
#include "sim/tree_integrator.h"
#include "sim/world_options.h"

namespace nao::sim {

/** A person's pull on a robot: a spring and a damper between a point of a link and a target. */
struct LinkDrag {
  int link = 0;
  /** m, in the link's frame. */
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /** m, in W; or in the frame of the root link, the torso. */
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  bool is_in_torso = false;
};

/** One simulated robot: the order in which its bodies (TreeIntegrator), motors (JointDrives) and
 * sensors take part in a tick and in a step.
 *
 * Users of a World see it as const; World and Stepper call the rest. It has more than 25 methods
 * since the phases of a step, which the contacts of all robots couple, are separate calls. */
class SimRobot {
 public:
  /** At rest with servos on, where the options say.
   * @throws ModelError, ConfigError  if the physics does not support the model, or the posture is
   * unknown. */
  SimRobot(std::shared_ptr<const RobotModel> model, const RobotOptions& options,
           const WorldOptions& world);
  SimRobot(const SimRobot&) = delete;
  SimRobot& operator=(const SimRobot&) = delete;

  const RobotModel& model() const { return *model_; }
  const RobotOptions& options() const { return options_; }
  const Tree& tree() const { return tree_; }
  const TreeState& state() const { return integrator_.state(); }
  const TreeDynamics& dynamics() const { return integrator_.dynamics(); }
  const Sensors& sensors() const { return sensors_; }
  const CollisionModel& collisions() const { return collisions_; }
  /** As set last. */
  const MotorTargets& targets() const { return targets_.newest(); }
  /** Whether the readings of this tick do not arrive, see RobotErrors::sensor_loss. */
  bool are_readings_lost() const { return are_readings_lost_; }

  /** Pose of a link in W; fingers turn with the opening. */
  Eigen::Isometry3d link_pose(int link) const;
  /** True angles (hands: openings), rad, and speeds, rad/s, at the end of the last tick; torques of
   * the last step, N m. In motor order. */
  const Eigen::VectorXd& motor_position() const { return motor_position_; }
  const Eigen::VectorXd& motor_velocity() const { return motor_velocity_; }
  const Eigen::VectorXd& motor_torque() const { return drives_.torque(); }
  /** Whether a motor moves no body of the physics, only an opening (of a hand). */
  bool is_opening(int motor) const { return drives_.is_opening(motor); }
  /** Kinetic (with rotors) and potential energy, and what the joint stops store, J. */
  double energy() const;
  /** See TreeIntegrator::is_within_bounds(). */
  bool is_within_bounds() const { return integrator_.is_within_bounds(); }

  /** Index of its first degree of freedom in the solver's vector. */
  int first_dof() const { return first_dof_; }
  void set_first_dof(int dof) { first_dof_ = dof; }

  /** Sets the targets that the next tick sends on their way, unless they are lost. */
  void set_targets(const MotorTargets& targets) {
    if (!are_targets_lost_) targets_.set(targets);
  }
  /** See World::place_robot(). */
  void place(const Posture* posture, const Eigen::Vector3d& ground_position,
             const Eigen::Quaterniond* orientation);
  /** Places the robot as its options say; its clock and its sensors' noise continue. */
  void return_to_start();
  /** Tick 0: servos on, motors cold, sensors with new biases. */
  void switch_on();
  /** For a robot that joins a world which has run so many ticks. @param period  Period of a tick,
   * s. */
  void set_tick(int64_t tick, double period) { sensors_.set_tick(tick, period); }
  /** Impulse at a link's center of mass in the next step, N s, in W. */
  void push(int link, const Eigen::Vector3d& impulse);

  /** See World::drag(). */
  void drag(const LinkDrag& drag);
  /** Applies the drag's force to the next step, of h seconds, while it lasts. */
  void apply_drag(double h);

  // A control tick: begin, steps, end.
  void begin_tick();
  void end_tick(double period);

  // A step of h seconds, in this order.

  /** Writes the scaled velocity that the robot would have without constraints, (num_dofs). */
  void begin_step(double h, Eigen::Ref<Eigen::VectorXd> scaled_velocity);
  /** Adds the constraint rows of joints and motors. */
  void add_joint_rows(double h, ConstraintSolver& solver);
  /** Adds bounds for motors that exceed their torque with the solver's present solution.
   * @param scaled_velocity  Scaled velocities of all bodies. @return Whether there were any. */
  bool add_missed_bounds(double h, const Eigen::VectorXd& scaled_velocity,
                         ConstraintSolver& solver);
  /** Takes over the velocities of the solution that add_missed_bounds() was given last. */
  void take_velocities() { integrator_.take_velocity(); }
  /** A contact force acts on the robot in this step. */
  void mark_in_contact() { is_in_contact_ = true; }
  /** The floor's impulse on a sole, N s, at a point; both in W. @param foot  0 left, 1 right. */
  void add_foot_load(int foot, const Eigen::Vector3d& point, const Eigen::Vector3d& impulse);
  /** Reads the solution and advances. */
  void end_step(double h, const ConstraintSolver& solver);

  // A step of h seconds in an engine other than the fast one: its joint forces and pushes, the
  // floor's impulses on the soles (add_foot_load()), then its end.

  const std::vector<JointForce>& begin_explicit_step(double h) {
    return drives_.begin_explicit_step(h, targets_.current(), state());
  }
  /** See TreeIntegrator::take_impulses(). */
  Eigen::VectorXd take_impulses() { return integrator_.take_impulses(); }
  /** See TreeIntegrator::calc_bias(). */
  const Eigen::VectorXd& calc_bias() { return integrator_.calc_bias(); }
  /** Within a step: what forces are computed from. */
  void set_state(const TreeState& state) { integrator_.set_state(state); }
  void end_explicit_step(double h, const TreeState& state);

 private:
  void place_joints(const std::vector<double>& position, const Eigen::Vector3d& ground_position,
                    const Eigen::Quaterniond& orientation);
  void update_motor_state();
  void draw_losses();
  const TrueMotion& true_motion();

  std::shared_ptr<const RobotModel> model_;
  RobotOptions options_;
  Tree tree_;
  CollisionModel collisions_;
  TreeIntegrator integrator_;
  JointDrives drives_;
  DelayedTargets targets_;
  SensorAccumulator accumulator_;
  Sensors sensors_;
  Floor floor_;
  /** Decides which messages are lost. */
  Random random_;
  bool are_readings_lost_ = false;
  bool are_targets_lost_ = false;
  LinkDrag drag_;
  /** Time for which the drag still acts, s. */
  double drag_time_ = 0;
  int first_dof_ = 0;
  bool is_in_contact_ = false;
  Eigen::VectorXd motor_position_;
  Eigen::VectorXd motor_velocity_;
  Eigen::VectorXd encoder_position_;
};

}  // namespace nao::sim
