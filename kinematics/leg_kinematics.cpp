#include "kinematics/leg_kinematics.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"

namespace nao {
namespace {

// Tolerance of axes (unit vectors) and positions, m: the URDF has nine digits.
constexpr double kTolerance = 1e-6;
// Slack of a cosine at the ends of the leg's reach: rounding only.
constexpr double kRounding = 1e-12;

Eigen::Matrix3d rotation_x(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
}

Eigen::Matrix3d rotation_y(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

Eigen::Matrix3d rotation_z(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/** Knee angle of two links whose ends are `distance` apart, by the law of cosines; stretched or
 * fully bent beyond reach. */
double knee_angle(double thigh, double tibia, double distance, bool& is_reachable) {
  const double cosine = (distance * distance - thigh * thigh - tibia * tibia) / (2 * thigh * tibia);
  is_reachable = cosine <= 1 + kRounding && cosine >= -1 - kRounding;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

LegKinematics::LegKinematics(const RobotModel& model)
    : left_(read_chain(model, "L", model.left_sole())),
      right_(read_chain(model, "R", model.right_sole())) {}

LegKinematics::Chain LegKinematics::read_chain(const RobotModel& model, const char* prefix,
                                               int sole) {
  const std::array<const char*, 6> names = {"HipYawPitch", "HipRoll",    "HipPitch",
                                            "KneePitch",   "AnklePitch", "AnkleRoll"};
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds) {
      throw ModelError("leg " + std::string(prefix) + " of " + model.name() +
                       " has no inverse kinematics: " + what);
    }
  };
  Chain chain{};
  std::array<const Joint*, 6> joints{};
  int parent = 0;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string name = prefix + std::string(names[i]);
    const int joint = model.find_joint(name);
    require(joint >= 0, "no joint " + name);
    joints[i] = &model.joints()[joint];
    require(joints[i]->parent_link == parent, name + " is not where it belongs");
    require(joints[i]->pose_in_parent.linear().isIdentity(kTolerance),
            name + " has a turned frame");
    parent = joints[i]->child_link;
    const int driver = joints[i]->mimic_joint;
    chain.motors[i] = model.find_motor(driver >= 0 ? model.joints()[driver].name : name);
    require(driver < 0 || (joints[i]->mimic_multiplier == 1 && joints[i]->mimic_offset == 0),
            name + " does not follow its motor one to one");
  }
  const auto is_axis = [&](int i, const Eigen::Vector3d& axis) {
    return joints[i]->axis.isApprox(axis, kTolerance);
  };
  const auto origin = [&](int i) -> Eigen::Vector3d {
    return joints[i]->pose_in_parent.translation();
  };
  require(std::abs(joints[0]->axis.x()) < kTolerance && is_axis(1, Eigen::Vector3d::UnitX()) &&
              is_axis(2, Eigen::Vector3d::UnitY()) && is_axis(3, Eigen::Vector3d::UnitY()) &&
              is_axis(4, Eigen::Vector3d::UnitY()) && is_axis(5, Eigen::Vector3d::UnitX()),
          "its axes are other than yaw-pitch, x, y, y, y, x");
  require(origin(1).norm() < kTolerance && origin(2).norm() < kTolerance,
          "its hip axes do not meet");
  require(origin(5).norm() < kTolerance, "its ankle axes do not meet");
  require(origin(3).head<2>().norm() < kTolerance && origin(4).head<2>().norm() < kTolerance,
          "its knee or ankle is off the line of the leg");
  const Joint& sole_joint = model.joints()[model.links()[sole].parent_joint];
  require(sole_joint.parent_link == parent && sole_joint.kind == Joint::Kind::kFixed &&
              sole_joint.pose_in_parent.linear().isIdentity(kTolerance),
          "its sole is not fixed to the foot");

  chain.hip = origin(0);
  chain.thigh = -origin(3).z();
  chain.tibia = -origin(4).z();
  chain.sole_offset = sole_joint.pose_in_parent.translation();
  const Eigen::Vector3d axis = joints[0]->axis;
  chain.sign = axis.z() < 0 ? -1 : 1;
  chain.tilt = std::atan2(-chain.sign * axis.y(), chain.sign * axis.z());
  return chain;
}

LegSolution LegKinematics::solve(Leg leg, const Eigen::Isometry3d& sole_in_torso) const {
  const Chain& c = chain(leg);
  LegSolution solution;
  const Eigen::Matrix3d& R_TF = sole_in_torso.linear();
  const Eigen::Vector3d p_hip_ankle =
      sole_in_torso.translation() - R_TF * c.sole_offset - c.hip;  // in T
  const double knee = knee_angle(c.thigh, c.tibia, p_hip_ankle.norm(), solution.is_reachable);

  // The hip seen from the ankle, in the foot's axes: AnkleRoll turns it into the plane of the leg.
  const Eigen::Vector3d q = R_TF.transpose() * -p_hip_ankle;
  // Of the two solutions the one with |roll| below 90 degrees, also if the hip of a folded leg is
  // below the ankle.
  const double up = std::copysign(std::hypot(q.y(), q.z()), q.z());
  const double ankle_roll = std::atan2(q.y() / up, q.z() / up);
  const double ankle_pitch =
      std::atan2(-c.thigh * std::sin(knee), c.tibia + c.thigh * std::cos(knee)) -
      std::atan2(q.x(), up);

  // The remaining rotation is the hip's: Rz(sign yaw) Rx(roll - tilt) Ry(pitch) in tilted axes.
  const Eigen::Matrix3d N =
      rotation_x(-c.tilt) * R_TF * rotation_x(-ankle_roll) * rotation_y(-(ankle_pitch + knee));
  const double hip_yaw_pitch = c.sign * std::atan2(-N(0, 1), N(1, 1));
  const double hip_roll = std::asin(std::clamp(N(2, 1), -1.0, 1.0)) + c.tilt;
  const double hip_pitch = std::atan2(-N(2, 0), N(2, 2));
  solution.angles = {hip_yaw_pitch, hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll};
  return solution;
}

LegSolution LegKinematics::solve_with_hip_yaw_pitch(Leg leg, const Eigen::Isometry3d& sole_in_torso,
                                                    double hip_yaw_pitch) const {
  const Chain& c = chain(leg);
  LegSolution solution;
  const Eigen::Matrix3d& R_TF = sole_in_torso.linear();
  const Eigen::Matrix3d R_TP =
      rotation_x(c.tilt) * rotation_z(c.sign * hip_yaw_pitch) * rotation_x(-c.tilt);
  const Eigen::Vector3d p =
      R_TP.transpose() * (sole_in_torso.translation() - R_TF * c.sole_offset - c.hip);
  const double knee = knee_angle(c.thigh, c.tibia, p.norm(), solution.is_reachable);

  // HipRoll turns the ankle into the plane of the leg, in which thigh and tibia are two links.
  const double down = std::copysign(std::hypot(p.y(), p.z()), -p.z());
  const double hip_roll = std::atan2(p.y() / down, -p.z() / down);
  const double hip_pitch = std::atan2(-p.x(), down) -
                           std::atan2(c.tibia * std::sin(knee), c.thigh + c.tibia * std::cos(knee));

  // The ankle's angles follow from the sole's normal in the tibia frame: n = Ry(pitch) Rx(roll)
  // e_z.
  const Eigen::Matrix3d R_T_tibia = R_TP * rotation_x(hip_roll) * rotation_y(hip_pitch + knee);
  const Eigen::Vector3d n = R_T_tibia.transpose() * R_TF.col(2);
  const double ankle_roll = std::asin(std::clamp(-n.y(), -1.0, 1.0));
  const double ankle_pitch = std::atan2(n.x(), n.z());
  solution.angles = {hip_yaw_pitch, hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll};
  return solution;
}

LegsSolution LegKinematics::solve_both(const Eigen::Isometry3d& left_sole_in_torso,
                                       const Eigen::Isometry3d& right_sole_in_torso,
                                       double left_weight) const {
  const double hip_yaw_pitch =
      left_weight * solve(Leg::kLeft, left_sole_in_torso).angles[0] +
      (1 - left_weight) * solve(Leg::kRight, right_sole_in_torso).angles[0];
  const LegSolution left = solve_with_hip_yaw_pitch(Leg::kLeft, left_sole_in_torso, hip_yaw_pitch);
  const LegSolution right =
      solve_with_hip_yaw_pitch(Leg::kRight, right_sole_in_torso, hip_yaw_pitch);
  return {left.angles, right.angles, left.is_reachable && right.is_reachable};
}

void LegKinematics::write(Leg leg, const LegAngles& angles, std::vector<double>& position) const {
  const Chain& c = chain(leg);
  for (size_t i = leg == Leg::kLeft ? 0 : 1; i < angles.size(); ++i) {
    position[c.motors[i]] = angles[i];
  }
}

LegAngles LegKinematics::read(Leg leg, const std::vector<double>& position) const {
  LegAngles angles{};
  for (size_t i = 0; i < angles.size(); ++i) angles[i] = position[chain(leg).motors[i]];
  return angles;
}

}  // namespace nao
