#pragma once

#include <Eigen/Geometry>
#include <utility>

#include "robot_model/scene_file.h"
#include "sim/constraint_solver.h"

namespace nao::sim {

/** The ball in W: center m, velocity m/s, angular velocity rad/s. */
struct BallState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
};

/** A solid sphere of six degrees of freedom: angular velocity, then velocity of the center, in W.
 *
 * Its mass matrix is diagonal, diag(I, I, I, m, m, m) with I = 2/5 m r^2, and so is the factor L of
 * M = L^T L that scales the solver's velocities. */
class Ball {
 public:
  explicit Ball(const BallDescription& description);

  const BallState& state() const { return state_; }
  double radius() const { return description_.radius; }
  /** Velocity of the point fixed to the ball that is at `point` now, m/s; both in W. */
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const {
    return state_.velocity + state_.angular_velocity.cross(point - state_.position);
  }
  /** Kinetic and potential energy, J. @param gravity  m/s^2, in W. */
  double energy(const Eigen::Vector3d& gravity) const;
  /** Whether the state is finite and within 1000 m of the origin. */
  bool is_within_bounds() const;

  /** Puts the ball at rest where the scene has it. */
  void reset();
  /** @param position  x, y, and height of the lowest point; m. @param velocity  m/s. */
  void place(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity);
  /** Impulse at the center in the next step, N s, in W. */
  void push(const Eigen::Vector3d& impulse) { impulse_ += impulse; }

  const BallDescription& description() const { return description_; }
  /** For engines other than the fast one: takes the pushes since the last step, N s, in W, and sets
   * the state at the end of a step. */
  Eigen::Vector3d take_impulse() { return std::exchange(impulse_, Eigen::Vector3d::Zero()); }
  void set_state(const BallState& state) { state_ = state; }

  /** Index of its first degree of freedom in the solver's vector. */
  int first_dof() const { return first_dof_; }
  void set_first_dof(int dof) { first_dof_ = dof; }

  /** Writes the scaled velocities at the end of a step of h seconds without contact.
   * @param gravity  m/s^2, in W. */
  void begin_step(double h, const Eigen::Vector3d& gravity, Eigen::VectorXd& scaled_velocity);
  /** Computes the rows of a contact block, L^-T J^T for the velocity of the ball, with entries for
   * its six degrees of freedom.
   * @param point  In W, m. @param frame  Normal and tangents in W, as columns.
   * @param rows  Three rows of three pairs. */
  void calc_contact_rows(const Eigen::Vector3d& point, const Eigen::Matrix3d& frame,
                         EntryPair* rows) const;
  /** Adds rolling resistance to the contact with the floor that was added last: a bound on the
   * torque, deceleration * (I + m r^2) / r, as a fraction of the normal force m g.
   * @param frame  As above. @param deceleration  Deceleration of a rolling ball, m/s^2.
   * @param gravity  m/s^2.
   */
  void add_rolling_resistance(const Eigen::Matrix3d& frame, double deceleration, double gravity,
                              ConstraintSolver& solver) const;
  /** Lever arm, m, that a normal force has for rolling resistance, and greatest torque of it: arm
   * times force. @param deceleration, gravity  As above. */
  double rolling_arm(double deceleration, double gravity) const;
  /** Moment of inertia about the center, kg m^2. */
  double inertia() const { return inertia_; }
  /** Takes over the solver's velocities and advances by h seconds. */
  void end_step(double h, const Eigen::VectorXd& scaled_velocity);

 private:
  BallDescription description_;
  /** About the center, kg m^2. */
  double inertia_;
  BallState state_;
  Eigen::Vector3d impulse_ = Eigen::Vector3d::Zero();
  int first_dof_ = 0;
};

}  // namespace nao::sim
