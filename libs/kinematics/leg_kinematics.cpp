#include "kinematics/leg_kinematics.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/error.h"
#include "kinematics/knee_bend.h"
#include "kinematics/leg_tolerances.h"

namespace nao {
namespace {

// Bend of the knee from which the search starts for a robot without a ready posture, rad: stretched
// legs can bend either way.
constexpr double kStartBend = 0.15;

Eigen::Matrix3d rotation_x(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
}

Eigen::Matrix3d rotation_y(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

Eigen::Matrix3d rotation_z(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

LegKinematics::LegKinematics(const RobotModel& model)
    : chains_{LegChain::read(model, Leg::kLeft), LegChain::read(model, Leg::kRight)} {
  choose_method(model);
}

void LegKinematics::choose_method(const RobotModel& model) {
  // Both legs share the first motor (the NAO's HipYawPitch): neither can be solved alone.
  if (chains_[0].motors[0] == chains_[1].motors[0]) {
    method_ = Method::kCoupled;
    for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
      coupled_[index(leg)] = read_coupled(model, leg);
      hips_[index(leg)] = coupled_[index(leg)].hip;
    }
    reach_ = coupled_[0].thigh + coupled_[0].tibia;
    return;
  }
  // Both legs must have the closed form; otherwise both are solved numerically.
  for (int i = 0; i < 2; ++i) analytic_[i] = AnalyticLegSolver::make(chains_[i]);
  if (analytic_[0] && analytic_[1]) method_ = Method::kAnalytic;
  const Posture* ready = model.find_posture(model.references().ready);
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const LegChain& c = chain(leg);
    const LegAngles start = ready != nullptr ? read(leg, ready->position) : c.calc_bent(kStartBend);
    numeric_[index(leg)].emplace(c, start);
    hips_[index(leg)] =
        method_ == Method::kAnalytic ? analytic_[index(leg)]->hip() : c.point[c.roles.hip_pitch];
  }
  // Length of thigh and tibia: the distance from hip to ankle of a straight leg.
  const LegChain& left = chains_[0];
  const Eigen::Vector3d& knee = left.point[left.roles.knee];
  const int ankle = left.roles.ankle_pitch;
  reach_ = (hips_[0] - knee).norm() +
           (knee - (ankle < 0 ? left.sole.translation() : left.point[ankle])).norm();
}

LegKinematics::CoupledLeg LegKinematics::read_coupled(const RobotModel& model, Leg leg) {
  const LegDescription& description = model.legs()[index(leg)];
  // The closed form below assumes the NAO's geometry; a model that differs is refused at start with
  // the difference, instead of solving wrongly.
  const auto require = [&](bool holds, const std::string& what) {
    if (!holds) {
      throw ModelError(std::string(leg == Leg::kLeft ? "the left" : "the right") + " leg of " +
                       model.name() + " has no inverse kinematics for its coupled hip: " + what);
    }
  };
  require(description.joints.size() == 6, "other joints lead to it");
  std::array<const Joint*, 6> joints{};
  // The hip's parent is the root, or fixed to it.
  int parent = model.joints()[description.joints[0]].parent_link;
  require(model.find_body(parent) == 0, "its first joint is not at the root");
  std::vector<const Joint*> mounts;
  for (int link = parent; link != 0; link = mounts.back()->parent_link) {
    mounts.push_back(&model.joints()[model.links()[link].parent_joint]);
  }
  // At the angles 0 in T: places of the joints from one another, and axes. Joint frames may be
  // turned; without turns the rotation is exactly the identity.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
  for (auto mount = mounts.rbegin(); mount != mounts.rend(); ++mount) {
    base += turn * (*mount)->pose_in_parent.translation();
    turn = turn * (*mount)->pose_in_parent.linear();
  }
  std::array<Eigen::Vector3d, 6> origin;
  std::array<Eigen::Vector3d, 6> axis;
  for (size_t i = 0; i < joints.size(); ++i) {
    joints[i] = &model.joints()[description.joints[i]];
    require(joints[i]->parent_link == parent, joints[i]->name + " is not where it belongs");
    origin[i] = turn * joints[i]->pose_in_parent.translation();
    turn = turn * joints[i]->pose_in_parent.linear();
    axis[i] = turn * joints[i]->axis;
    parent = joints[i]->child_link;
  }
  const auto is_axis = [&](int i, int direction) {
    return std::abs(std::abs(axis[i][direction]) - 1) < kLegTolerance;
  };
  require(std::abs(axis[0].x()) < kLegTolerance && is_axis(1, 0) && is_axis(2, 1) &&
              is_axis(3, 1) && is_axis(4, 1) && is_axis(5, 0),
          "its axes are other than yaw-pitch, x, y, y, y, x");
  require(origin[1].norm() < kLegTolerance && origin[2].norm() < kLegTolerance,
          "its hip axes do not meet");
  require(origin[5].norm() < kLegTolerance, "its ankle axes do not meet");
  require(origin[3].head<2>().norm() < kLegTolerance && origin[4].head<2>().norm() < kLegTolerance,
          "its knee or ankle is off the line of the leg");
  const Joint& sole_joint = model.joints()[model.links()[description.sole].parent_joint];
  require(sole_joint.parent_link == parent && sole_joint.kind == Joint::Kind::kFixed &&
              (turn * sole_joint.pose_in_parent.linear()).isIdentity(kLegTolerance),
          "its sole is not fixed to the foot");

  CoupledLeg result{};
  result.hip = base + origin[0];
  result.thigh = -origin[3].z();
  result.tibia = -origin[4].z();
  result.sole_offset = turn * sole_joint.pose_in_parent.translation();
  // Axis of HipYawPitch in T: z rotated by `tilt` about x, with the joint's sense as `sign`.
  result.sign = axis[0].z() < 0 ? -1 : 1;
  result.tilt = std::atan2(-result.sign * axis[0].y(), result.sign * axis[0].z());
  for (size_t i = 0; i < axis.size(); ++i) {
    result.senses[i] = i == 0 || axis[i].sum() > 0 ? 1 : -1;
  }
  return result;
}

LegSolution LegKinematics::solve(Leg leg, const Eigen::Isometry3d& sole_in_torso) const {
  switch (method_) {
    case Method::kCoupled:
      return solve_coupled(coupled_[index(leg)], sole_in_torso);
    case Method::kAnalytic:
      return analytic_[index(leg)]->solve(sole_in_torso);
    case Method::kNumeric:
      break;
  }
  return numeric_[index(leg)]->solve(sole_in_torso);
}

LegSolution LegKinematics::solve_coupled(const CoupledLeg& c,
                                         const Eigen::Isometry3d& sole_in_torso) const {
  LegSolution solution;
  const Eigen::Matrix3d& R_TF = sole_in_torso.linear();
  const Eigen::Vector3d p_hip_ankle =
      sole_in_torso.translation() - R_TF * c.sole_offset - c.hip;  // in T
  // Law of cosines in the triangle hip, knee, ankle.
  const double knee = knee_bend(c.thigh, c.tibia, p_hip_ankle.norm(), solution.is_reachable);

  // The hip seen from the ankle, in the foot's axes: AnkleRoll turns it into the plane of the leg.
  const Eigen::Vector3d q = R_TF.transpose() * -p_hip_ankle;
  // Take the solution with |roll| below 90 degrees, even if the hip of a folded leg is below the
  // ankle.
  const double up = std::copysign(std::hypot(q.y(), q.z()), q.z());
  const double ankle_roll = std::atan2(q.y() / up, q.z() / up);
  // In the plane of the leg: direction of the hip as the bent leg has it, less the one that it must
  // have.
  const double ankle_pitch =
      std::atan2(-c.thigh * std::sin(knee), c.tibia + c.thigh * std::cos(knee)) -
      std::atan2(q.x(), up);

  // The remaining rotation is the hip's: Rz(sign yaw) Rx(roll - tilt) Ry(pitch) in tilted axes.
  const Eigen::Matrix3d N =
      rotation_x(-c.tilt) * R_TF * rotation_x(-ankle_roll) * rotation_y(-(ankle_pitch + knee));
  // N = Rz(yaw) Rx(roll) Ry(pitch) has N(0,1) = -sin(yaw) cos(roll), N(1,1) = cos(yaw) cos(roll),
  // N(2,1) = sin(roll), N(2,0) = -cos(roll) sin(pitch), N(2,2) = cos(roll) cos(pitch).
  const double hip_yaw_pitch = c.sign * std::atan2(-N(0, 1), N(1, 1));
  const double hip_roll = std::asin(std::clamp(N(2, 1), -1.0, 1.0)) + c.tilt;
  const double hip_pitch = std::atan2(-N(2, 0), N(2, 2));
  solution.angles =
      c.with_senses({hip_yaw_pitch, hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll});
  return solution;
}

// With the shared joint given five angles are left for six conditions: the ankle's position and the
// sole's normal are kept, the foot's heading follows from the rest.
LegSolution LegKinematics::solve_with_hip_yaw_pitch(Leg leg, const Eigen::Isometry3d& sole_in_torso,
                                                    double hip_yaw_pitch) const {
  const CoupledLeg& c = coupled_[index(leg)];
  LegSolution solution;
  const Eigen::Matrix3d& R_TF = sole_in_torso.linear();
  // Rotation of the pelvis-side link by HipYawPitch about its tilted axis.
  const Eigen::Matrix3d R_TP =
      rotation_x(c.tilt) * rotation_z(c.sign * hip_yaw_pitch) * rotation_x(-c.tilt);
  // Ankle seen from the hip, in that link's axes.
  const Eigen::Vector3d p =
      R_TP.transpose() * (sole_in_torso.translation() - R_TF * c.sole_offset - c.hip);
  const double knee = knee_bend(c.thigh, c.tibia, p.norm(), solution.is_reachable);

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
  solution.angles =
      c.with_senses({hip_yaw_pitch, hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll});
  return solution;
}

LegsSolution LegKinematics::solve_both(const Eigen::Isometry3d& left_sole_in_torso,
                                       const Eigen::Isometry3d& right_sole_in_torso,
                                       double left_weight) const {
  if (method_ != Method::kCoupled) {
    const LegSolution left = solve(Leg::kLeft, left_sole_in_torso);
    const LegSolution right = solve(Leg::kRight, right_sole_in_torso);
    return {left.angles, right.angles, left.is_reachable && right.is_reachable};
  }
  // Each leg's own solution asks for an angle of the shared motor. Neither foot has its exact
  // heading at the mean; one with weight 1 does.
  const double hip_yaw_pitch =
      left_weight * solve(Leg::kLeft, left_sole_in_torso).angles[0] +
      (1 - left_weight) * solve(Leg::kRight, right_sole_in_torso).angles[0];
  const LegSolution left = solve_with_hip_yaw_pitch(Leg::kLeft, left_sole_in_torso, hip_yaw_pitch);
  const LegSolution right =
      solve_with_hip_yaw_pitch(Leg::kRight, right_sole_in_torso, hip_yaw_pitch);
  return {left.angles, right.angles, left.is_reachable && right.is_reachable};
}

void LegKinematics::write(Leg leg, const LegAngles& angles, std::vector<double>& position) const {
  // The right leg does not write the shared motor: both solutions have the same angle.
  const bool has_own_first = leg == Leg::kLeft || method_ != Method::kCoupled;
  const std::vector<int>& all = motors(leg);
  for (size_t i = has_own_first ? 0 : 1; i < all.size(); ++i) position[all[i]] = angles[i];
}

LegAngles LegKinematics::read(Leg leg, const std::vector<double>& position) const {
  LegAngles angles{};
  const std::vector<int>& all = motors(leg);
  for (size_t i = 0; i < all.size(); ++i) angles[i] = position[all[i]];
  return angles;
}

}  // namespace nao
