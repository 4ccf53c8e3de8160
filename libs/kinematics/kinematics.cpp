#include "kinematics/kinematics.h"

namespace nao {

Kinematics::Kinematics(const RobotModel& model)
    : model_(&model),
      link_poses_(model.links().size(), Eigen::Isometry3d::Identity()),
      mass_(model.total_mass()) {
  // Joints are sorted from the root to the leaves: a parent's pose is known before its children
  // need it.
  std::vector<int> motor_of_joint(model.joints().size(), -1);
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    motor_of_joint[model.motors()[motor]] = motor;
  }
  for (size_t i = 0; i < model.joints().size(); ++i) {
    const Joint& joint = model.joints()[i];
    JointEntry entry{joint.parent_link,
                     joint.child_link,
                     joint.pose_in_parent,
                     joint.axis,
                     joint.pose_in_parent.linear().isIdentity(0),
                     motor_of_joint[i],
                     1,
                     0};
    if (joint.mimic_joint >= 0) {
      // Mimic joint (URDF): angle = multiplier * angle of the motor's joint + offset. Its motion
      // counts to the motor's column.
      entry.motor = motor_of_joint[joint.mimic_joint];
      entry.multiplier = joint.mimic_multiplier;
      entry.offset = joint.mimic_offset;
    }
    joints_.push_back(entry);
  }
  update(std::vector<double>(model.num_motors(), 0.0));
}

void Kinematics::update(const std::vector<double>& position) {
  for (const JointEntry& joint : joints_) {
    const Eigen::Isometry3d& parent = link_poses_[joint.parent_link];
    Eigen::Isometry3d& child = link_poses_[joint.child_link];
    // X_TC = X_TP X_PJ R(axis, angle), with T the torso, P the parent and J the joint's frame. Most
    // joints of a NAO are not turned in their parents: the product with the identity is left out.
    child.translation() =
        parent.translation() + parent.linear() * joint.pose_in_parent.translation();
    Eigen::Matrix3d rotation = parent.linear();
    if (!joint.is_pure_translation) rotation *= joint.pose_in_parent.linear();
    if (joint.motor >= 0) {
      const double angle = joint.multiplier * position[joint.motor] + joint.offset;
      rotation *= Eigen::AngleAxisd(angle, joint.axis).toRotationMatrix();
    }
    child.linear() = rotation;
  }
  center_of_mass_.setZero();
  const std::vector<Link>& links = model_->links();
  for (size_t i = 0; i < links.size(); ++i) {
    if (links[i].mass > 0) {
      // Sum of m_i p_i, divided by the total mass below.
      center_of_mass_ += links[i].mass * (link_poses_[i] * links[i].center_of_mass);
    }
  }
  center_of_mass_ /= mass_;
}

// In the torso frame T, m per rad; `point` in T as well.
Eigen::Matrix3Xd Kinematics::calc_point_jacobian(int link, const Eigen::Vector3d& point) const {
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, model_->num_motors());
  for (int joint = model_->links()[link].parent_joint; joint >= 0;
       joint = model_->links()[joints_[joint].parent_link].parent_joint) {
    const JointEntry& entry = joints_[joint];
    if (entry.motor < 0) continue;
    // Revolute joint: dp/dq = axis x (p - origin of the joint), in T. Only the joints between the
    // link and the torso move the point; columns of the others remain 0.
    const Eigen::Isometry3d& pose = link_poses_[entry.child_link];
    const Eigen::Vector3d axis = pose.linear() * entry.axis * entry.multiplier;
    jacobian.col(entry.motor) += axis.cross(point - pose.translation());
  }
  return jacobian;
}

Eigen::Matrix3Xd Kinematics::calc_angular_jacobian(int link) const {
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, model_->num_motors());
  for (int joint = model_->links()[link].parent_joint; joint >= 0;
       joint = model_->links()[joints_[joint].parent_link].parent_joint) {
    const JointEntry& entry = joints_[joint];
    if (entry.motor < 0) continue;
    // Angular velocities about the axes of a chain add up, wherever the axes are.
    jacobian.col(entry.motor) +=
        link_poses_[entry.child_link].linear() * entry.axis * entry.multiplier;
  }
  return jacobian;
}

Eigen::Matrix3Xd Kinematics::calc_center_of_mass_jacobian() const {
  // Cost is linear in the number of links, in contrast to a sum over pairs of joints and links.
  // All links beyond a joint turn with it as one body (composite rigid body): sum their masses and
  // first moments from the leaves to the root.
  const std::vector<Link>& links = model_->links();
  std::vector<double> mass(links.size());
  std::vector<Eigen::Vector3d> moment(links.size());
  for (size_t i = 0; i < links.size(); ++i) {
    mass[i] = links[i].mass;
    moment[i] = links[i].mass * (link_poses_[i] * links[i].center_of_mass);
  }
  Eigen::Matrix3Xd jacobian = Eigen::Matrix3Xd::Zero(3, model_->num_motors());
  for (auto joint = joints_.rbegin(); joint != joints_.rend(); ++joint) {
    const int child = joint->child_link;
    mass[joint->parent_link] += mass[child];
    moment[joint->parent_link] += moment[child];
    if (joint->motor < 0) continue;
    const Eigen::Isometry3d& pose = link_poses_[child];
    const Eigen::Vector3d axis = pose.linear() * joint->axis * joint->multiplier;
    // dc/dq = axis x (sum of m_i (p_i - origin)) / M over the links beyond the joint.
    jacobian.col(joint->motor) +=
        axis.cross(moment[child] - mass[child] * pose.translation()) / mass_;
  }
  return jacobian;
}

}  // namespace nao
