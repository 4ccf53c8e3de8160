#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Where every part of the robot is for given joint angles: link poses, centre of mass, Jacobians.
 *
 * All results are seen from the torso T (the root link), in metres and radians. Call update()
 * first; the other functions then cost little. The model must outlive this. Exact to rounding. */
class Kinematics {
 public:
  explicit Kinematics(const RobotModel& model);

  /** Takes over joint angles. @param position  rad (hands: opening), (num_motors), motor order. */
  void update(const std::vector<double>& position);

  const RobotModel& model() const { return *model_; }

  /** Pose of a link's frame in T. @param link  Index into RobotModel::links(). */
  const Eigen::Isometry3d& link_pose(int link) const { return link_poses_[link]; }
  const Eigen::Isometry3d& left_sole() const { return link_poses_[model_->left_sole()]; }
  const Eigen::Isometry3d& right_sole() const { return link_poses_[model_->right_sole()]; }

  /** Whole-body centre of mass in T, m. */
  const Eigen::Vector3d& center_of_mass() const { return center_of_mass_; }
  /** kg. */
  double mass() const { return mass_; }

  /** Derivative of a point fixed to a link by the motors' angles.
   * @param point  In T, m. @return m/rad, (3 x num_motors), expressed in T. */
  Eigen::Matrix3Xd calc_point_jacobian(int link, const Eigen::Vector3d& point) const;

  /** Angular velocity of a link per motor velocity. @return (3 x num_motors), expressed in T. */
  Eigen::Matrix3Xd calc_angular_jacobian(int link) const;

  /** Derivative of the centre of mass by the motors' angles.
   * @return m/rad, (3 x num_motors), expressed in T. */
  Eigen::Matrix3Xd calc_center_of_mass_jacobian() const;

 private:
  struct JointEntry {
    int parent_link;
    int child_link;
    Eigen::Isometry3d pose_in_parent;
    Eigen::Vector3d axis;
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
