#include "kinematics/leg_chain.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/error.h"

namespace nao {
namespace {

/** Joints of one leg that are not shared with the other leg. */
std::vector<int> own_joints(const RobotModel& model, Leg leg) {
  const std::vector<int>& joints = model.legs()[leg == Leg::kLeft ? 0 : 1].joints;
  const std::vector<int>& others = model.legs()[leg == Leg::kLeft ? 1 : 0].joints;
  std::vector<int> own;
  for (const int joint : joints) {
    if (std::find(others.begin(), others.end(), joint) == others.end()) own.push_back(joint);
  }
  return own;
}

/** Directions of the joints by their greatest component: 0 roll, 1 pitch, 2 yaw. A hip axis that is
 * tilted between yaw and pitch counts as yaw. */
int direction_of(const Eigen::Vector3d& axis) {
  // The tilt of a yaw-pitch axis is 45 degrees: the two components are equal up to rounding.
  constexpr double kTie = 1e-6;
  const Eigen::Vector3d size = axis.cwiseAbs();
  if (size.z() >= size.y() - kTie && size.z() >= size.x() - kTie) return 2;
  return size.y() >= size.x() ? 1 : 0;
}

/** @return false if the joints' directions are not those of a leg. */
bool find_roles(const std::array<Eigen::Vector3d, 6>& axis, LegRoles& roles) {
  std::vector<int> rolls;
  std::vector<int> pitches;
  std::vector<int> yaws;
  for (int i = 0; i < 6; ++i) {
    const int direction = direction_of(axis[i]);
    // Order along the chain matters: the first roll is the hip's, the last the ankle's.
    (direction == 0 ? rolls : direction == 1 ? pitches : yaws).push_back(i);
    roles.sign[i] = axis[i][direction] < 0 ? -1 : 1;
  }
  if (rolls.size() != 2 || pitches.size() != 3 || yaws.size() != 1) return false;
  roles.hip_yaw = yaws[0];
  roles.hip_roll = rolls[0];
  roles.hip_pitch = pitches[0];
  roles.knee = pitches[1];
  roles.ankle_pitch = pitches[2];
  roles.ankle_roll = rolls[1];
  // The three hip joints come before the knee in any order; the knee is the fourth joint.
  const int last_of_hip = std::max({roles.hip_yaw, roles.hip_roll, roles.hip_pitch});
  return last_of_hip < roles.knee && roles.knee == 3;
}

}  // namespace

LegChain LegChain::read(const RobotModel& model, Leg leg) {
  const std::string name = leg == Leg::kLeft ? "left leg" : "right leg";
  const auto fail = [&](const std::string& what) {
    throw ModelError("the " + name + " of " + model.name() + " has no inverse kinematics: " + what);
  };
  const std::vector<int> joints = own_joints(model, leg);
  LegChain chain;
  if (joints.size() != chain.motors.size()) {
    fail("it has " + std::to_string(joints.size()) + " joints of its own instead of 6");
  }
  // All joints at 0: axes and points of the product of exponentials, in T.
  const std::vector<Eigen::Isometry3d> poses =
      model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  for (size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = model.joints()[joints[i]];
    chain.motors[i] = model.motor_of(joints[i]);
    if (joint.mimic_joint >= 0 && (joint.mimic_multiplier != 1 || joint.mimic_offset != 0)) {
      fail(joint.name + " does not follow its motor one to one");
    }
    const Eigen::Isometry3d& pose = poses[joint.child_link];
    chain.axis[i] = pose.linear() * joint.axis;
    chain.point[i] = pose.translation();
    chain.lower[i] = joint.lower;
    chain.upper[i] = joint.upper;
  }
  chain.sole = poses[model.legs()[leg == Leg::kLeft ? 0 : 1].sole];
  if (!find_roles(chain.axis, chain.roles)) {
    fail(
        "its axes are other than yaw, roll and pitch of the hip in any order, the knee's pitch, "
        "and "
        "pitch and roll of the ankle");
  }
  return chain;
}

Eigen::Isometry3d LegChain::calc_sole(const LegAngles& angles) const {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  // Product of exponentials: sole(q) = exp(S_1 q_1) ... exp(S_6 q_6) sole(0).
  for (size_t i = 0; i < angles.size(); ++i) {
    // exp(S q): a rotation about the axis through the point.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angles[i], axis[i]).toRotationMatrix();
    translation += rotation * (point[i] - turn * point[i]);
    rotation *= turn;
  }
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation * sole.linear();
  result.translation() = rotation * sole.translation() + translation;
  return result;
}

}  // namespace nao
