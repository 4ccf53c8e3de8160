#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "robot_model/robot_parts.h"

namespace nao {

/** The tree of links and joints of a robot, its motors, and their limits.
 *
 * Links, joints and motors have one order, which follows from the structure of the robot and not
 * from its files (order_joints()). */
class RobotMechanism {
 public:
  /** All links, parents before children; the first is the root. */
  const std::vector<Link>& links() const { return links_; }
  /** All joints; a joint's parent link comes before its child. */
  const std::vector<Joint>& joints() const { return joints_; }

  /** Joints that have a motor, as indices into joints(): motor order. Fixed and mimic joints are
   * not among them. */
  const std::vector<int>& motors() const { return motor_joints_; }
  int num_motors() const { return static_cast<int>(motor_joints_.size()); }
  const Joint& motor_joint(int motor) const { return joints_[motor_joints_[motor]]; }
  const Motor& motor(int motor) const { return motors_[motor]; }
  /** Names of the motors' joints, in motor order. */
  const std::vector<std::string>& motor_names() const { return motor_names_; }

  /** @return Index, or -1 if there is none of that name. */
  int find_link(const std::string& name) const;
  int find_joint(const std::string& name) const;
  int find_motor(const std::string& name) const;

  /** The motor that moves a joint, its own or that of the joint that it mimics; -1: none. */
  int motor_of(int joint) const;

  /** The joints that move from the root to a link, root first: revolute ones, mimics included. */
  std::vector<int> find_chain(int link) const;
  /** Whether a revolute joint is on the way from the root to a link. */
  bool moves(int joint, int link) const;
  /** The first link of the rigid body that a link belongs to. */
  int find_body(int link) const;

  const std::vector<CoupledLimit>& coupled_limits() const { return coupled_limits_; }
  /** Pairs of links (indices, the smaller first) whose contact is not a self-collision. */
  const std::vector<std::pair<int, int>>& allowed_contacts() const { return allowed_contacts_; }

  /** Sum of all links, kg. */
  double total_mass() const;

  /** Angle of every joint of joints() from the motors' angles, mimic joints included; 0 for fixed
   * ones. @param position  rad, (num_motors), motor order. @return rad, (joints().size()).
   * @throws std::invalid_argument  for another number of positions. */
  std::vector<double> joint_positions(const std::vector<double>& position) const;

  /** Pose of every link in the root's frame. @param position  rad, (num_motors), motor order. */
  std::vector<Eigen::Isometry3d> link_poses(const std::vector<double>& position) const;

  /** Clips an angle to the joint's own and coupled limits.
   * @param angle  rad. @param position  The other motors' angles, rad, (num_motors). */
  double clip_to_limits(int motor, double angle, const std::vector<double>& position) const;

 protected:
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::vector<int> motor_joints_;
  std::vector<std::string> motor_names_;
  std::vector<Motor> motors_;
  std::vector<CoupledLimit> coupled_limits_;
  std::vector<std::pair<int, int>> allowed_contacts_;
};

}  // namespace nao
