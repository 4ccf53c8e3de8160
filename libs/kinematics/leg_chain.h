#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

enum class Leg { kLeft = 0, kRight = 1 };

/** Greatest number of joints of one leg. */
constexpr int kMaxLegJoints = 8;

/** Angles of the joints of one leg, rad, from the root to the sole; 0 beyond its last joint. */
using LegAngles = std::array<double, kMaxLegJoints>;

/** Result of the inverse kinematics for one leg. */
struct LegSolution {
  LegAngles angles{};
  /** False if no angles put the sole there. The angles then bring it near: analytic solutions
   * stretch the leg towards it, or bend the knee fully. */
  bool is_reachable = true;
};

/** Functions of the joints of a leg, as indices into LegAngles; -1: it has no such joint. Hip roll,
 * hip pitch and knee always exist. */
struct LegRoles {
  int hip_yaw = -1;
  int hip_roll = -1;
  int hip_pitch = -1;
  int knee = -1;
  int ankle_pitch = -1;
  int ankle_roll = -1;
  /** 1 or -1: a positive angle turns about +x (roll), +y (pitch), +z (yaw) of the root, or about
   * the opposite direction. */
  std::array<double, kMaxLegJoints> sign{};
};

/** The joints of one leg as screw axes: each joint's axis and a point on it, in the root's frame,
 * at the angle 0 of all joints.
 *
 * The pose of the sole is X(q) = exp(S_1 q_1) ... exp(S_n q_n) X(0), the product of exponentials.
 * Joints that both legs have in common, such as a waist, are held at the angle 0.
 *
 * Source: K. Lynch, F. Park, "Modern Robotics", Cambridge 2017, chapter 4. */
struct LegChain {
  std::vector<int> motors;
  std::array<Eigen::Vector3d, kMaxLegJoints> axis;
  std::array<Eigen::Vector3d, kMaxLegJoints> point;
  Eigen::Isometry3d sole = Eigen::Isometry3d::Identity();
  /** Limits of the joints, rad. */
  LegAngles lower{};
  LegAngles upper{};
  LegRoles roles;
  /** 1 or -1: the sense of the knee's angle in which the leg bends. */
  double bend_sign = 1;

  /** @throws ModelError  unless the leg has three to eight joints of its own, among them the hip's
   * roll and pitch and the knee. */
  static LegChain read(const RobotModel& model, Leg leg);

  int num_joints() const { return static_cast<int>(motors.size()); }
  /** Angles within the limits with a bent knee, hip and ankle half as much the other way, so that
   * the sole stays level. @param bend  rad, 0 or more. */
  LegAngles calc_bent(double bend) const;

  /** Pose of the sole in the root's frame. */
  Eigen::Isometry3d calc_sole(const LegAngles& angles) const;
};

}  // namespace nao
