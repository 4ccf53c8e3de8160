#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/constraint_solver.h"
#include "sim/tree.h"
#include "sim/tree_kernels.h"

namespace nao::sim {

/** Mass, first moment and rotational inertia of a body about some origin, W's axes. */
struct SpatialInertia {
  double mass = 0;
  /** Mass times center of mass, kg m. */
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  /** About the origin, kg m^2. */
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();

  SpatialInertia() = default;
  SpatialInertia(const PackedInertia& packed)
      : mass(packed.mass), moment(packed.moment), inertia(packed.inertia) {}
};

/** Angular and linear part of a motion or a force, about some origin, W's axes. */
struct SpatialVector {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();

  SpatialVector() = default;
  SpatialVector(const Eigen::Vector3d& angular_part, const Eigen::Vector3d& linear_part)
      : angular(angular_part), linear(linear_part) {}
  SpatialVector(const PackedSpatial& packed) : angular(packed.angular), linear(packed.linear) {}
  operator PackedSpatial() const { return {angular, linear}; }
};

/** Poses, mass matrix and bias forces of a tree in one state, and linear systems with its mass
 * matrix. All memory is allocated in the constructor.
 *
 * Spatial vectors are expressed in W's axes about the root's present origin O, so that no quantity
 * has to be transformed from body to body. Source: R. Featherstone, Rigid Body Dynamics Algorithms
 * (2008): recursive Newton-Euler, table 5.1; composite rigid bodies, table 6.2; sparse
 * factorization L^T L without fill-in, table 6.3 and section 6.5.
 *
 * It has more than 25 methods since they share poses and inertias that update_kinematics()
 * computes: the kinematics, the linear algebra of the mass matrix, and the momentum of the whole
 * tree. */
class TreeDynamics {
 public:
  /** @param is_root_fixed  Whether the root is held fixed: its accelerations are 0.
   * @param kernels  Must outlive this. */
  explicit TreeDynamics(const Tree& tree, bool is_root_fixed = false,
                        const TreeKernels& kernels = tree_kernels());
  TreeDynamics(const TreeDynamics&) = delete;
  TreeDynamics& operator=(const TreeDynamics&) = delete;

  /** Computes poses, joint axes and body velocities of a state. Call before all other methods. */
  void update_kinematics(const TreeState& state);
  /** Computes body velocities of a state with the poses of the last update_kinematics(). */
  void update_velocities(const TreeState& state);
  /** Computes the mass matrix M, without the rotors, if it is not that of the last
   * update_kinematics() already. */
  void update_mass_matrix();
  /** Bias forces: those for which all accelerations are 0 (Coriolis, centrifugal and gravity), N m
   * and N, (num_dofs). After update_kinematics(). @param gravity  m/s^2, in W. */
  void calc_bias(const Eigen::Vector3d& gravity, Eigen::VectorXd& bias);

  /** result = M x, (num_dofs); M as in update_mass_matrix(). */
  void multiply_by_mass(const Eigen::VectorXd& x, Eigen::VectorXd& result) const;
  /** Factorizes M + diagonal = L^T L. @param diagonal  (num_dofs), not negative. */
  void factorize(const Eigen::VectorXd& diagonal);
  /** x := L^-T x and x := L^-1 x; one after the other solves (M + diagonal) y = x. */
  void solve_upper(Eigen::VectorXd& x) const;
  void solve_lower(Eigen::VectorXd& x) const;

  /** Row of L^-1, that is L^-T e for the unit vector e of a dof: entries for the dof's ancestors,
   * rising, and for the dof itself. After factorize(). */
  const EntryPair* inverse_row(int dof) const {
    return &inverse_[static_cast<size_t>(dof) * pairs_of_row_];
  }
  /** Its squared length: the diagonal entry of (M + diagonal)^-1. */
  double inverse_square(int dof) const { return inverse_squares_[dof]; }
  /** L^-T J^T, where J maps the generalized velocity to a body's spatial velocity about O: six rows
   * (angular x, y, z, linear x, y, z), one after the other, with entries for the body's chain.
   * After factorize(). */
  void calc_body_rows(int body, EntryPair* rows) const;
  double mass_matrix(int row, int column) const;
  /** All of M, (num_dofs, num_dofs), which is allocated if it has another size. */
  void copy_mass_matrix(Eigen::MatrixXd& mass) const;

  /** Body frame B in W: rotation and origin, m. */
  Eigen::Matrix3d rotation(int body) const { return bodies_[body].rotation; }
  Eigen::Vector3d position(int body) const { return bodies_[body].position; }
  Eigen::Isometry3d pose(int body) const;
  /** A point fixed to a body, in W. @param point  In B, m. */
  Eigen::Vector3d point_in_world(int body, const Eigen::Vector3d& point) const {
    const BodyState& now = bodies_[body];
    const Packed3* r = now.rotation.columns;
    const double x = point.x();
    const double y = point.y();
    const double z = point.z();
    return {now.position.x + (r[0].x * x + r[1].x * y + r[2].x * z),
            now.position.y + (r[0].y * x + r[1].y * y + r[2].y * z),
            now.position.z + (r[0].z * x + r[1].z * y + r[2].z * z)};
  }
  /** Center of mass of a body in W, m. */
  Eigen::Vector3d body_center_of_mass(int body) const {
    return origin_ + Eigen::Vector3d(bodies_[body].com_from_O);
  }
  /** Velocity of the point fixed to a body that is at `point` now; both in W. */
  Eigen::Vector3d velocity_at(int body, const Eigen::Vector3d& point) const {
    // v + w x arm, written out: faster than Eigen's.
    const Packed3& w = bodies_[body].velocity.angular;
    const Packed3& v = bodies_[body].velocity.linear;
    const double x = point.x() - origin_.x();
    const double y = point.y() - origin_.y();
    const double z = point.z() - origin_.z();
    return {v.x + (w.y * z - w.z * y), v.y + (w.z * x - w.x * z), v.z + (w.x * y - w.y * x)};
  }
  Eigen::Vector3d angular_velocity(int body) const { return bodies_[body].velocity.angular; }
  const Eigen::Vector3d& origin() const { return origin_; }
  /** Motion of a body per unit of its joint's dof. Bodies other than the root. */
  SpatialVector motion(int body) const { return bodies_[body].motion; }

  /** Momentum of the whole tree about O. */
  SpatialVector momentum() const;
  /** Motion of the tree as one rigid body, joints held, that has a momentum about O. After
   * update_mass_matrix(). */
  SpatialVector rigid_motion(const SpatialVector& momentum) const;
  /** Momentum of the whole tree about O with a generalized velocity, which may differ from that of
   * the state. After update_mass_matrix(); not with a fixed root. */
  SpatialVector momentum_at(const Eigen::VectorXd& velocity) const;
  /** Changes the root's velocity so that the whole tree has a momentum about O; joint rates stay.
   * After update_mass_matrix().
   * @param velocity  Generalized velocity; its first six are changed. @return The change. */
  SpatialVector set_momentum(const SpatialVector& target, Eigen::VectorXd& velocity);

  /** Quantities of the whole tree: center of mass, m; linear momentum, N s; angular momentum about
   * the center of mass, N m s; kinetic energy, J, without the rotors. All in W. */
  Eigen::Vector3d center_of_mass() const { return origin_ + center_of_mass_from_origin(); }
  Eigen::Vector3d center_of_mass_from_origin() const;
  Eigen::Vector3d linear_momentum() const;
  Eigen::Vector3d angular_momentum() const;
  double kinetic_energy() const;

 private:
  /** Adds to the mass matrix what a body contributes that is not in series. */
  void add_coupled_body(int body);
  /** A row of one of the matrices below. */
  double* row_of(std::vector<EntryPair>& matrix, int dof) const {
    return matrix[static_cast<size_t>(dof) * pairs_of_row_].data();
  }
  const double* row_of(const std::vector<EntryPair>& matrix, int dof) const {
    return matrix[static_cast<size_t>(dof) * pairs_of_row_].data();
  }

  const Tree& tree_;
  bool is_root_fixed_;
  int num_dofs_;
  bool has_mass_matrix_ = false;
  /** Length of a row in memory: that of the longest. */
  int pairs_of_row_ = 0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  const TreeKernels& kernels_;
  std::vector<BodyConstants> constants_;
  std::vector<MatrixRow> matrix_rows_;
  /** The lists of matrix_rows_, one after the other. */
  std::vector<int> ancestor_rows_;
  /** Joints' dofs in the order in which factorize() eliminates them. */
  std::vector<int> elimination_order_;
  std::vector<BodyState> bodies_;
  /** Lower triangles of M, L and L^-1, row by row, without the entries outside the tree's pattern:
   * a row has entries for the dof's ancestors, rising, and for the dof itself. */
  std::vector<EntryPair> mass_;
  std::vector<EntryPair> factor_;
  std::vector<EntryPair> inverse_;
  std::vector<double> inverse_squares_;
};

}  // namespace nao::sim
