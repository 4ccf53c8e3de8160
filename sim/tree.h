#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao::sim {

class SimbodyModel;

/** One rigid body of a Tree. The origin of its frame B is on the axis of the joint that moves it.
 */
struct TreeBody {
  /** Body index; -1 for the root, which moves freely. */
  int parent = -1;
  /** Index into RobotModel::joints() of the joint that moves it; -1 for the root. */
  int joint = -1;
  /** Degree of freedom that rotates it; 0 for the root, which has the first six. */
  int dof = 0;
  /** Angle of its joint = ratio * coordinate + offset; 1 and 0 unless the joint is a mimic. */
  double ratio = 1;
  double offset = 0;
  /** Unit axis, the same in B and in the joint's frame. */
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  /** B at angle 0 in the parent's frame: origin, m, and rotation. */
  Eigen::Vector3d origin_in_parent = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation_in_parent = Eigen::Matrix3d::Identity();
  /** Whether rotation_in_parent is the identity. */
  bool is_parallel = true;
  /** kg; center of mass in B, m; rotational inertia about it in B's axes, kg m^2. */
  double mass = 0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  /** Degrees of freedom that move the body, rising, the root's six first; where a mimic joint is
   * between the body and the root, perhaps others as well, so that it ends with a dof and all its
   * ancestors. */
  std::vector<int> chain;
  /** Whether the chain has one dof for each body on the way from the root, in this order. */
  bool is_in_series = true;
};

/** A robot's bodies and joints as constants, as plain arrays for a physics step.
 *
 * **Generalized velocity.** Degrees of freedom (dofs) 0..2 are the root's angular velocity and 3..5
 * the velocity of its origin, both in the world, W; then one for each joint that is not a mimic
 * joint, in the order of the bodies. A mimic joint shares the dof of the joint that it follows,
 * wherever in the tree the two are. The dofs form a tree (`dof_ancestors`): entry (i, j) of the
 * mass matrix is 0 unless one of the two is an ancestor of the other (branch-induced sparsity;
 * Featherstone, Rigid Body Dynamics Algorithms, 2008, 6.4). With mimic joints it is the elimination
 * tree of the mass matrix (Davis, Direct Methods for Sparse Linear Systems, 2006, 4.1). */
class Tree {
 public:
  /** Builds the robot's Simbody system and reads frames, axes and mass properties from it.
   * @param mass_scale, torso_com  As SimbodyModel's.
   * @throws ModelError  as SimbodyModel does. */
  explicit Tree(const RobotModel& robot, double mass_scale = 1,
                const Eigen::Vector3d& torso_com = Eigen::Vector3d::Zero());
  explicit Tree(const SimbodyModel& model);

  const std::vector<TreeBody>& bodies() const { return bodies_; }
  int num_bodies() const { return static_cast<int>(bodies_.size()); }
  int num_dofs() const { return static_cast<int>(dof_ancestors_.size()); }
  /** Dofs that move the joint of `dof`, rising. */
  const std::vector<int>& dof_ancestors(int dof) const { return dof_ancestors_[dof]; }
  /** The body whose joint has the dof as its own (not a mimic's). */
  int body_of_dof(int dof) const { return dof_body_[dof]; }
  double total_mass() const { return total_mass_; }
  /** Body that carries a link, and the link's frame in it (openings at 0). */
  int body_of_link(int link) const { return link_body_[link]; }
  const Eigen::Isometry3d& pose_in_body(int link) const { return link_pose_[link]; }

 private:
  void find_ancestors();

  std::vector<TreeBody> bodies_;
  std::vector<std::vector<int>> dof_ancestors_;
  std::vector<int> dof_body_;
  double total_mass_ = 0;
  std::vector<int> link_body_;
  std::vector<Eigen::Isometry3d> link_pose_;
};

/** Position and velocity of a tree. */
struct TreeState {
  /** Root's origin in W, m, and rotation that re-expresses in W a vector given in the root. */
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /** rad, (num_dofs): the joints' coordinates; the first six are unused and 0. */
  Eigen::VectorXd coordinate;
  /** rad/s and m/s, (num_dofs). */
  Eigen::VectorXd velocity;

  explicit TreeState(int num_dofs)
      : coordinate(Eigen::VectorXd::Zero(num_dofs)), velocity(Eigen::VectorXd::Zero(num_dofs)) {}
};

}  // namespace nao::sim
