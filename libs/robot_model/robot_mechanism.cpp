#include "robot_model/robot_mechanism.h"

#include <algorithm>
#include <stdexcept>

namespace nao {
namespace {

template <class Items>
int find_named(const Items& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&name](const auto& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

/** Piecewise linear interpolation, constant beyond the first and last point. @param x  Rising. */
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const size_t next = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  if (next == 0) {
    return y.front();
  }
  if (next == x.size()) {
    return y.back();
  }
  const double fraction = (at - x[next - 1]) / (x[next] - x[next - 1]);
  return y[next - 1] + fraction * (y[next] - y[next - 1]);
}

}  // namespace

int RobotMechanism::find_link(const std::string& name) const {
  return find_named(links_, name);
}

int RobotMechanism::find_joint(const std::string& name) const {
  return find_named(joints_, name);
}

int RobotMechanism::find_motor(const std::string& name) const {
  for (int motor = 0; motor < num_motors(); ++motor) {
    if (motor_joint(motor).name == name) {
      return motor;
    }
  }
  return -1;
}

// A mimic joint belongs to the motor of the joint that it follows; -1 for fixed joints.
int RobotMechanism::motor_of(int joint) const {
  const int driver = joints_[joint].mimic_joint >= 0 ? joints_[joint].mimic_joint : joint;
  const auto found = std::find(motor_joints_.begin(), motor_joints_.end(), driver);
  return found == motor_joints_.end() ? -1 : static_cast<int>(found - motor_joints_.begin());
}

// Walks from the link to the root, and returns the joints from the root on.
std::vector<int> RobotMechanism::find_chain(int link) const {
  std::vector<int> chain;
  for (int joint = links_[link].parent_joint; joint >= 0;
       joint = links_[joints_[joint].parent_link].parent_joint) {
    if (joints_[joint].kind == Joint::Kind::kRevolute) chain.push_back(joint);
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

bool RobotMechanism::moves(int joint, int link) const {
  const std::vector<int> chain = find_chain(link);
  return std::find(chain.begin(), chain.end(), joint) != chain.end();
}

// The first link above which is not fixed to its parent: rigidly connected links are one body.
int RobotMechanism::find_body(int link) const {
  int joint = links_[link].parent_joint;
  while (joint >= 0 && joints_[joint].kind == Joint::Kind::kFixed) {
    link = joints_[joint].parent_link;
    joint = links_[link].parent_joint;
  }
  return link;
}

double RobotMechanism::total_mass() const {
  double mass = 0;
  for (const Link& link : links_) {
    mass += link.mass;
  }
  return mass;
}

std::vector<double> RobotMechanism::joint_positions(const std::vector<double>& position) const {
  if (position.size() != motor_joints_.size()) {
    throw std::invalid_argument(std::to_string(position.size()) + " motor positions instead of " +
                                std::to_string(motor_joints_.size()));
  }
  std::vector<double> angles(joints_.size(), 0.0);
  for (size_t motor = 0; motor < motor_joints_.size(); ++motor) {
    angles[motor_joints_[motor]] = position[motor];
  }
  for (size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].mimic_joint >= 0) {
      angles[i] =
          joints_[i].mimic_multiplier * angles[joints_[i].mimic_joint] + joints_[i].mimic_offset;
    }
  }
  return angles;
}

// Forward kinematics in the root's frame. Joints are sorted from the root outwards, so that the
// parent's pose is known.
std::vector<Eigen::Isometry3d> RobotMechanism::link_poses(
    const std::vector<double>& position) const {
  const std::vector<double> angles = joint_positions(position);
  std::vector<Eigen::Isometry3d> poses(links_.size(), Eigen::Isometry3d::Identity());
  for (size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    poses[joint.child_link] =
        poses[joint.parent_link] * joint.pose_in_parent * Eigen::AngleAxisd(angles[i], joint.axis);
  }
  return poses;
}

double RobotMechanism::clip_to_limits(int motor, double angle,
                                      const std::vector<double>& position) const {
  double lower = motor_joint(motor).lower;
  double upper = motor_joint(motor).upper;
  // A joint may have several coupled ranges; the narrowest of all counts.
  for (const CoupledLimit& limit : coupled_limits_) {
    if (limit.motor == motor) {
      const double other = position[limit.other_motor];
      lower = std::max(lower, interpolate(limit.other_position, limit.lower, other));
      upper = std::min(upper, interpolate(limit.other_position, limit.upper, other));
    }
  }
  return std::clamp(angle, lower, upper);
}

}  // namespace nao
