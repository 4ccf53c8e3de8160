#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/collision_model.h"
#include "sim/constraint_solver.h"
#include "sim/motor.h"
#include "sim/sensors.h"
#include "sim/tree.h"
#include "sim/tree_dynamics.h"
#include "sim/world_options.h"

namespace nao::sim {

/** Where the motors shall go, in motor order. */
struct MotorTargets {
  /** rad (hands: opening). */
  Eigen::VectorXd position;
  /** Share of the torque that each motor may use, 0 to 1. */
  Eigen::VectorXd stiffness;
};

/** Memory of one possible contact between steps. */
struct ContactSlot {
  /** N s, in W: last step's solution. */
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  /** Tangential spring of a sticking contact, m, in W. */
  Eigen::Vector3d stretch = Eigen::Vector3d::Zero();
  int64_t last_step = -2;
};

/** One simulated robot: bodies, motors, sensors. World steps it. */
class SimRobot {
 public:
  SimRobot(std::shared_ptr<const RobotModel> model, const RobotOptions& options,
           const WorldOptions& world);
  ~SimRobot();
  SimRobot(const SimRobot&) = delete;
  SimRobot& operator=(const SimRobot&) = delete;

  const RobotModel& model() const { return *model_; }
  const RobotOptions& options() const { return options_; }
  const Tree& tree() const { return tree_; }
  const TreeState& state() const { return state_; }
  const TreeDynamics& dynamics() const { return dynamics_; }
  const Sensors& sensors() const { return sensors_; }
  const CollisionModel& collisions() const { return collisions_; }

  /** Pose of a link in W; fingers turn with the opening. */
  Eigen::Isometry3d link_pose(int link) const;
  /** True angles (hands: openings), speeds and motor torques, motor order. */
  const Eigen::VectorXd& motor_position() const { return motor_position_; }
  const Eigen::VectorXd& motor_velocity() const { return motor_velocity_; }
  const Eigen::VectorXd& motor_torque() const { return motor_torque_; }

 private:
  friend class World;

  /** Puts the robot somewhere at rest, targets at where the motors are. */
  void place(const std::vector<double>& position, const Eigen::Vector3d& ground_position,
             const Eigen::Quaterniond& orientation);
  /** Torso orientation in which a posture rests: soles level when it stands or crouches, on back or
   * belly when it lies. */
  Eigen::Quaterniond resting_orientation(const Posture* posture) const;
  Eigen::Quaterniond sitting_orientation(const Posture& posture) const;
  double lowest_point() const;
  void switch_on();
  /** Places the robot as its options say; keeps its clock and sensors running. */
  void return_to_start();
  /** Impulse at a body's centre of mass in the next step, N s, in W. */
  void add_impulse(int body, const Eigen::Vector3d& impulse);
  void add_foot_load(int sole, const Eigen::Vector3d& point, const Eigen::Vector3d& impulse);
  double energy() const;

  // A control tick.
  void begin_tick();
  void end_tick(double period);

  // A step of h seconds, in this order; `z` is the robot's part of the solver's vector.
  void begin_step(double h, Eigen::Ref<Eigen::VectorXd> z);
  void add_joint_rows(double h, ConstraintSolver& solver, int first_dof);
  /** Adds bounds for motors that exceed their torque with the solver's present answer. @return
   * Whether there were any. */
  bool add_missed_bounds(double h, const Eigen::VectorXd& z, ConstraintSolver& solver,
                         int first_dof);
  /** Takes over the velocities of the solver's present answer, as add_missed_bounds() found them.
   */
  void take_velocities();
  /** Right after take_velocities(). */
  void end_step(double h, const ConstraintSolver& solver);

  int add_dof_entries(int dof, ConstraintSolver& solver, int first_dof);
  void add_motor_bound(int motor, bool is_upper, bool is_braking, double h,
                       ConstraintSolver& solver, int first_dof);
  void update_motor_arrays();
  /** Means over the tick so far. */
  const TrueMotion& update_truth();
  bool is_sane() const;

  std::shared_ptr<const RobotModel> model_;
  RobotOptions options_;
  Tree tree_;
  TreeState state_;
  TreeDynamics dynamics_;
  CollisionModel collisions_;
  Sensors sensors_;

  std::vector<Drive> drives_;
  /** Motor of each dof, -1 for the root's. */
  std::vector<int> motor_of_dof_;
  MotorTargets targets_;
  std::vector<MotorTargets> delayed_targets_;
  /** Targets' positions in the last step. */
  Eigen::VectorXd last_aim_;
  int64_t num_ticks_ = 0;
  /** What the last step's new configuration changed of the root's velocity. */
  SpatialVector root_change_;
  /** Whether anything presses on it in this step. World tells. */
  bool is_touched_ = false;

  Eigen::Vector3d gravity_;
  std::vector<ContactSlot> floor_slots_;
  std::vector<ContactSlot> self_slots_;
  Eigen::VectorXd external_impulse_;

  // Workspace of a step, (num_dofs).
  Eigen::VectorXd bias_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd work_;
  Eigen::VectorXd momentum_;
  std::vector<int> entry_of_dof_;
  std::vector<int> position_;

  // Sums over the steps of a tick.
  Eigen::VectorXd motor_position_;
  Eigen::VectorXd motor_velocity_;
  Eigen::VectorXd motor_torque_;
  Eigen::VectorXd torque_sum_;
  Eigen::Vector3d specific_force_sum_;
  Eigen::Vector3d angular_velocity_sum_;
  Eigen::Vector3d accelerometer_velocity_;
  std::array<TrueMotion::FootLoad, 2> foot_impulse_;
  double tick_time_ = 0;
  TrueMotion truth_;
};

}  // namespace nao::sim
