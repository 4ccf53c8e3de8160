#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/tree_dynamics.h"

namespace nao::sim {

/** Makes the damping of a robot's contacts implicit in an otherwise explicit step (a linearly
 * implicit Euler step, E. Hairer, G. Wanner, "Solving ordinary differential equations II", 1996,
 * section IV.9).
 *
 * With the velocity at the end of a step of length h, the damping D of a contact whose velocity is
 * J u changes its force by -h D J u'. The equations of motion are then (M + h sum(J^T D J)) u' = f,
 * which is stable for any D. An explicit step is not: the link of a foot whose gears are in their
 * play weighs a tenth of the leg, and D of its four to eight points turns it around in each step.
 *
 * All contacts of the same two bodies together are one damping of their relative spatial velocity
 * about the robot's origin O (TreeDynamics). */
class ContactDamping {
 public:
  /** What the contacts of two bodies have in common. */
  struct Pair {
    /** Bodies of the robot; -1: not of this robot. */
    int body_a = -1;
    int body_b = -1;
    /** D of a's spatial velocity relative to b's, angular before linear. */
    Eigen::Matrix<double, 6, 6> damping;
    /** From u to that velocity, (6, num_dofs), and the dofs whose column is not 0. */
    Eigen::Matrix<double, 6, Eigen::Dynamic> rows;
    std::vector<int> dofs;
  };

  /** @param tree, dynamics  Tree and dynamics of the robot. Must outlive this. */
  ContactDamping(const Tree& tree, const TreeDynamics& dynamics)
      : tree_(tree), dynamics_(dynamics) {}

  void clear() { num_pairs_ = 0; }
  /** Adds a contact, of the pose that the dynamics has now. @param body_a, body_b  As in Pair.
   * @param point  m, in W. @param damping  D, N s/m, in W. */
  void add(int body_a, int body_b, const Eigen::Vector3d& point, const Eigen::Matrix3d& damping);

  /** Adds h J^T D J of all contacts to the lower triangle of a mass matrix, (num_dofs, num_dofs).
   * @param h  s. */
  void add_to_mass(double h, Eigen::MatrixXd& mass) const;
  /** Calls work(body, force) for each body, with its spatial force -h D J u' about O.
   * @param acceleration  u', (num_dofs). */
  template <class Work>
  void for_each_force(double h, const Eigen::VectorXd& acceleration, Work work) const {
    for (int i = 0; i < num_pairs_; ++i) {
      const Pair& pair = pairs_[i];
      Eigen::Matrix<double, 6, 1> change = Eigen::Matrix<double, 6, 1>::Zero();
      for (const int dof : pair.dofs) change += acceleration[dof] * pair.rows.col(dof);
      const Eigen::Matrix<double, 6, 1> on_a = -h * (pair.damping * change);
      const SpatialVector force(on_a.head<3>(), on_a.tail<3>());
      if (pair.body_a >= 0) work(pair.body_a, force);
      if (pair.body_b >= 0) work(pair.body_b, SpatialVector(-force.angular, -force.linear));
    }
  }

 private:
  Pair& pair_of(int body_a, int body_b);
  void add_rows(int body, double sign, Pair& pair) const;

  const Tree& tree_;
  const TreeDynamics& dynamics_;
  /** The first num_pairs_ are in use; the others keep their memory. */
  std::vector<Pair> pairs_;
  int num_pairs_ = 0;
};

}  // namespace nao::sim
