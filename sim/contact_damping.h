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
 */
class ContactDamping {
 public:
  struct Contact {
    /** Bodies of the robot; -1: not of this robot. */
    int body_a = -1;
    int body_b = -1;
    /** m, in W. */
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    /** D, N s/m, in W. */
    Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();
    /** J: from u to the velocity of a's point relative to b's, (3, num_dofs). */
    Eigen::Matrix3Xd rows;
    /** Dofs whose column of J is not 0. */
    std::vector<int> dofs;
  };

  /** @param tree, dynamics  Tree and dynamics of the robot. Must outlive this. */
  ContactDamping(const Tree& tree, const TreeDynamics& dynamics)
      : tree_(tree), dynamics_(dynamics) {}

  void clear() { contacts_.clear(); }
  /** Adds a contact, of the pose that the dynamics has now. Parameters as in Contact. */
  void add(int body_a, int body_b, const Eigen::Vector3d& point, const Eigen::Matrix3d& damping);
  const std::vector<Contact>& contacts() const { return contacts_; }

  /** Adds h J^T D J of all contacts to a mass matrix, (num_dofs, num_dofs). @param h  s. */
  void add_to_mass(double h, Eigen::MatrixXd& mass) const;
  /** -h D J u', N, on body a. @param acceleration  u', (num_dofs). */
  static Eigen::Vector3d force_on_a(const Contact& contact, double h,
                                    const Eigen::VectorXd& acceleration) {
    return -h * contact.damping * (contact.rows * acceleration);
  }

 private:
  void add_rows(int body, const Eigen::Vector3d& point, double sign, Eigen::Matrix3Xd& rows) const;

  const Tree& tree_;
  const TreeDynamics& dynamics_;
  std::vector<Contact> contacts_;
};

}  // namespace nao::sim
