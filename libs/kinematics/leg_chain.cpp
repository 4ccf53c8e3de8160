#include "kinematics/leg_chain.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/error.h"
#include "kinematics/leg_joints.h"

namespace nao {
namespace {

// Component along x, the sine of an angle, above which a tilted hip axis can roll the leg.
constexpr double kTilted = 0.3;

/** Directions of the joints by their greatest component: 0 roll, 1 pitch, 2 yaw. A hip axis that is
 * tilted between yaw and pitch counts as yaw. */
int direction_of(const Eigen::Vector3d& axis) {
  // The tilt of a yaw-pitch axis is 45 degrees: the two components are equal up to rounding.
  constexpr double kTie = 1e-6;
  const Eigen::Vector3d size = axis.cwiseAbs();
  if (size.z() >= size.y() - kTie && size.z() >= size.x() - kTie) return 2;
  return size.y() >= size.x() ? 1 : 0;
}

// Distance of a second pitch axis from the sole, fraction of its distance from the first one, below
// which it is the ankle's and not the knee's.
constexpr double kAnkleDistance = 0.4;

/** The knee among the pitch joints: the one farthest from hip and ankle. -1: none. */
int find_knee(const LegChain& chain, const std::vector<int>& pitches) {
  const Eigen::Vector3d hip = chain.point[pitches.front()];
  const auto distance = [&](int i, const Eigen::Vector3d& from) {
    return (chain.point[i] - from).cross(chain.axis[i]).norm();
  };
  if (pitches.size() == 2) {
    const double shank = distance(pitches[1], chain.sole.translation());
    return shank < kAnkleDistance * distance(pitches[1], hip) ? -1 : pitches[1];
  }
  const Eigen::Vector3d ankle = chain.point[pitches.back()];
  int knee = -1;
  double farthest = 0;
  for (size_t i = 1; i + 1 < pitches.size(); ++i) {
    const double apart = std::min(distance(pitches[i], hip), distance(pitches[i], ankle));
    if (apart <= farthest) continue;
    farthest = apart;
    knee = pitches[i];
  }
  return knee;
}

/** @return The function that no joint has and a leg needs; empty: none. */
std::string find_roles(LegChain& chain) {
  LegRoles& roles = chain.roles;
  std::array<int, kMaxLegJoints> direction{};
  std::vector<int> pitches;
  for (int i = 0; i < chain.num_joints(); ++i) {
    direction[i] = direction_of(chain.axis[i]);
    if (direction[i] == 1) pitches.push_back(i);
  }
  if (pitches.empty()) return "pitch of the hip";
  roles.hip_pitch = pitches.front();
  roles.knee = pitches.size() < 2 ? -1 : find_knee(chain, pitches);
  if (roles.knee < 0) return "knee";
  if (pitches.back() != roles.knee) roles.ankle_pitch = pitches.back();
  // Order along the chain matters: rolls before the knee are the hip's, those after it the ankle's.
  for (int i = 0; i < chain.num_joints(); ++i) {
    int& roll = i < roles.knee ? roles.hip_roll : roles.ankle_roll;
    if (direction[i] == 0 && roll < 0) roll = i;
    if (direction[i] == 2 && roles.hip_yaw < 0) roles.hip_yaw = i;
  }
  // Two hip axes at 45 degrees between roll and yaw: the second one is the roll.
  for (int i = roles.knee - 1; i >= 0 && roles.hip_roll < 0; --i) {
    if (direction[i] != 2 || i == roles.hip_yaw || std::abs(chain.axis[i].x()) < kTilted) continue;
    roles.hip_roll = i;
    direction[i] = 0;
  }
  for (int i = 0; i < chain.num_joints(); ++i) {
    roles.sign[i] = chain.axis[i][direction[i]] < 0 ? -1 : 1;
  }
  return roles.hip_roll < 0 ? "roll of the hip" : "";
}

// Difference of a knee's limits, fraction of its range, above which they tell how it bends.
constexpr double kOneSided = 0.2;

/** The sense of the knee's angle in which the leg bends: that of its longer range; of a symmetric
 * one that in which hip and ankle follow farther, or else the one that takes the shank back. */
double find_bend_sign(const LegChain& chain) {
  const LegRoles& roles = chain.roles;
  const double lower = chain.lower[roles.knee];
  const double upper = chain.upper[roles.knee];
  if (std::abs(lower + upper) > kOneSided * (upper - lower)) return upper > -lower ? 1 : -1;
  const auto deepest = [&](double sign) {
    double bend = sign > 0 ? upper : -lower;
    for (const int role : {roles.hip_pitch, roles.ankle_pitch}) {
      if (role < 0) continue;
      const double turn = -sign * roles.sign[roles.knee] * roles.sign[role];
      bend = std::min(bend, 2 * (turn > 0 ? chain.upper[role] : -chain.lower[role]));
    }
    return bend;
  };
  const double more = deepest(1) - deepest(-1);
  if (std::abs(more) > 0.5 * kOneSided * (upper - lower)) return more > 0 ? 1 : -1;
  return roles.sign[roles.knee];
}

}  // namespace

LegChain LegChain::read(const RobotModel& model, Leg leg) {
  const std::string name = leg == Leg::kLeft ? "left leg" : "right leg";
  const auto fail = [&](const std::string& what) {
    throw ModelError("the " + name + " of " + model.name() + " has no inverse kinematics: " + what);
  };
  const std::vector<int> joints = own_leg_joints(model, leg == Leg::kLeft ? 0 : 1);
  LegChain chain;
  if (joints.size() < 3 || joints.size() > size_t{kMaxLegJoints}) {
    fail("it has " + std::to_string(joints.size()) + " joints of its own instead of 3 to " +
         std::to_string(kMaxLegJoints));
  }
  // All joints at 0: axes and points of the product of exponentials, in T.
  const std::vector<Eigen::Isometry3d> poses =
      model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  for (size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = model.joints()[joints[i]];
    chain.motors.push_back(model.motor_of(joints[i]));
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
  const std::string missing = find_roles(chain);
  if (!missing.empty()) fail("no joint is the " + missing);
  chain.bend_sign = find_bend_sign(chain);
  return chain;
}

LegAngles LegChain::calc_bent(double bend) const {
  const double knee = bend_sign * bend;
  LegAngles angles{};
  for (const int role : {roles.hip_pitch, roles.ankle_pitch}) {
    if (role >= 0) angles[role] = -0.5 * knee * roles.sign[roles.knee] * roles.sign[role];
  }
  angles[roles.knee] = knee;
  for (int i = 0; i < num_joints(); ++i) angles[i] = std::clamp(angles[i], lower[i], upper[i]);
  return angles;
}

Eigen::Isometry3d LegChain::calc_sole(const LegAngles& angles) const {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  // Product of exponentials: sole(q) = exp(S_1 q_1) ... exp(S_n q_n) sole(0).
  for (int i = 0; i < num_joints(); ++i) {
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
