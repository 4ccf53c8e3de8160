#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Forward kinematics for given joint angles: link poses, center of mass, Jacobians.
 *
 * All results are expressed in the torso frame T (the root link), in metres and radians. update()
 * composes the link poses from the root to the leaves,
 *     X_TC = X_TP X_PJ R(axis, q)        for each joint J from parent link P to child link C,
 * and the other functions read them. A Jacobian has one column per motor: for a revolute joint with
 * axis a and origin o in T, the geometric Jacobian's column is a x (p - o) for the linear and a for
 * the angular velocity; joints that mimic a motor add to its column.
 *
 * The model must outlive this. Exact to rounding.
 *
 * Source: R. Featherstone, "Rigid Body Dynamics Algorithms", Springer 2008. */
class Kinematics {
 public:
  explicit Kinematics(const RobotModel& model);

  /** Computes all link poses. @param position  rad (hands: opening), (num_motors), motor order. */
  void update(const std::vector<double>& position);

  const RobotModel& model() const { return *model_; }

  /** Pose of a link's frame in T. @param link  Index into RobotModel::links(). */
  const Eigen::Isometry3d& link_pose(int link) const { return link_poses_[link]; }
  const Eigen::Isometry3d& left_sole() const { return link_poses_[model_->left_sole()]; }
  const Eigen::Isometry3d& right_sole() const { return link_poses_[model_->right_sole()]; }

  /** Whole-body center of mass in T, m. */
  const Eigen::Vector3d& center_of_mass() const { return center_of_mass_; }
  /** kg. */
  double mass() const { return mass_; }

  /** Jacobian of a point that is fixed to a link: its velocity per motor velocity.
   * @param point  In T, m. @return m/rad, (3 x num_motors), expressed in T. */
  Eigen::Matrix3Xd calc_point_jacobian(int link, const Eigen::Vector3d& point) const;

  /** Angular Jacobian of a link: its angular velocity per motor velocity.
   * @return (3 x num_motors), expressed in T. */
  Eigen::Matrix3Xd calc_angular_jacobian(int link) const;

  /** Jacobian of the center of mass: its velocity per motor velocity.
   * @return m/rad, (3 x num_motors), expressed in T. */
  Eigen::Matrix3Xd calc_center_of_mass_jacobian() const;

 private:
  /** A joint as update() needs it. */
  struct JointEntry {
    int parent_link;
    int child_link;
    Eigen::Isometry3d pose_in_parent;
    Eigen::Vector3d axis;
    /** The joint frame is parallel to the parent's: one matrix product less. */
    bool is_pure_translation;
    /** Motor that moves it, -1 if it is fixed; angle = multiplier * motor angle + offset. */
    int motor;
    double multiplier;
    double offset;
  };

  const RobotModel* model_;
  std::vector<JointEntry> joints_;
  std::vector<Eigen::Isometry3d> link_poses_;
  Eigen::Vector3d center_of_mass_ = Eigen::Vector3d::Zero();
  double mass_ = 0;
};

}  // namespace nao
