#pragma once

#include <Eigen/Geometry>

#include "sim/tree.h"
#include "sim/tree_dynamics.h"

namespace nao::sim {

/** State of one robot's tree, and its time step: momentum, velocities, positions.
 *
 * Semi-implicit Euler in terms of momentum. With mass matrix M, velocity u, bias forces c (Coriolis
 * and gravity), joint forces f and their implicit part D (damping, and reflected rotor inertia):
 *
 *     (M + D) u' = M u + h (f - c) + impulses.
 *
 * The solver works on L u' with M + D = L^T L. */
class TreeIntegrator {
 public:
  /** @param tree  Must outlive this. @param is_root_fixed  Whether the root is held fixed.
   * @param gravity  m/s^2, in W. */
  TreeIntegrator(const Tree& tree, bool is_root_fixed, const Eigen::Vector3d& gravity);

  const TreeState& state() const { return state_; }
  const TreeDynamics& dynamics() const { return dynamics_; }
  const Eigen::Vector3d& gravity() const { return gravity_; }

  /** At rest. @param coordinate  rad, (num_dofs). @param position  Root's origin in W, m. */
  void place(const Eigen::VectorXd& coordinate, const Eigen::Vector3d& position,
             const Eigen::Quaterniond& orientation);
  /** Moves the root's origin without a velocity. @param position  In W, m. */
  void move_root(const Eigen::Vector3d& position);
  /** Impulse at a body's center of mass in the next step, N s, in W. */
  void add_impulse(int body, const Eigen::Vector3d& impulse);
  /** The same at a point of the body; in W, m. */
  void add_impulse_at(int body, const Eigen::Vector3d& point, const Eigen::Vector3d& impulse);

  /** Generalized impulses of the pushes since the last step, N m s and N s, (num_dofs), for other
   * engines; they are removed. */
  Eigen::VectorXd take_impulses();
  /** Bias forces of the state, with gravity, for other engines: see TreeDynamics::calc_bias().
   * Valid until the next call. */
  const Eigen::VectorXd& calc_bias() {
    dynamics_.calc_bias(gravity_, bias_);
    return bias_;
  }
  /** Takes over a state that another engine has computed, with its mass matrix. */
  void set_state(const TreeState& state);

  // A step of h seconds, in this order.

  /** Computes mass matrix and momentum, without joint forces. */
  void begin_step(double h);
  /** Adds a joint's impulse h f, N m s, and the diagonal entry of D, kg m^2. */
  void add_joint_impulse(int dof, double impulse, double implicit) {
    momentum_[dof] += impulse;
    diagonal_[dof] = implicit;
  }
  /** Factorizes M + D. @return The scaled velocity L u' without constraints, (num_dofs). */
  const Eigen::VectorXd& factorize();
  /** Computes the velocity u' of a scaled velocity. */
  template <class ScaledVelocity>
  const Eigen::VectorXd& velocity_of(const ScaledVelocity& scaled_velocity) {
    work_ = scaled_velocity;
    dynamics_.solve_lower(work_);
    return work_;
  }
  /** Takes over the result of the last velocity_of() as the tree's velocity. */
  void take_velocity();
  /** Advances by h seconds. @param is_in_contact  Whether a contact force acted in the step. */
  void integrate(double h, bool is_in_contact);

  /** Whether the state is finite and within what a valid simulation reaches: 300 rad/s, 100 m/s,
   * 1000 m from the origin, 0.2 m below the floor. */
  bool is_within_bounds() const;

 private:
  const Tree& tree_;
  bool is_root_fixed_;
  Eigen::Vector3d gravity_;
  TreeState state_;
  TreeDynamics dynamics_;
  /** Change of the root's velocity by the last step's change of configuration, see integrate(). */
  SpatialVector root_change_;
  /** Generalized impulses of pushes, (num_dofs). */
  Eigen::VectorXd external_impulse_;
  // Workspace of a step, (num_dofs).
  Eigen::VectorXd bias_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd momentum_;
  Eigen::VectorXd work_;
};

}  // namespace nao::sim
