#pragma once

#include <Eigen/Geometry>
#include <array>

#include "robot_model/robot_model.h"

namespace nao {

enum class Leg { kLeft = 0, kRight = 1 };

/** Angles of the six joints of one leg, rad, from the root to the sole. */
using LegAngles = std::array<double, 6>;

/** Result of the inverse kinematics for one leg. */
struct LegSolution {
  LegAngles angles{};
  /** False if no angles put the sole there. The angles then bring it near: analytic solutions
   * stretch the leg towards it, or bend the knee fully. */
  bool is_reachable = true;
};

/** Functions of the six joints of a leg, as indices into LegAngles. */
struct LegRoles {
  int hip_yaw = -1;
  int hip_roll = -1;
  int hip_pitch = -1;
  int knee = -1;
  int ankle_pitch = -1;
  int ankle_roll = -1;
  /** 1 or -1: a positive angle turns about +x (roll), +y (pitch), +z (yaw) of the root, or about
   * the opposite direction. */
  std::array<double, 6> sign{};
};

/** The joints of one leg as screw axes: each joint's axis and a point on it, in the root's frame,
 * at the angle 0 of all joints.
 *
 * The pose of the sole is X(q) = exp(S_1 q_1) ... exp(S_6 q_6) X(0), the product of exponentials.
 * Joints that both legs have in common, such as a waist, are held at the angle 0.
 *
 * Source: K. Lynch, F. Park, "Modern Robotics", Cambridge 2017, chapter 4. */
struct LegChain {
  std::array<int, 6> motors{};
  std::array<Eigen::Vector3d, 6> axis;
  std::array<Eigen::Vector3d, 6> point;
  Eigen::Isometry3d sole = Eigen::Isometry3d::Identity();
  /** Limits of the joints, rad. */
  LegAngles lower{};
  LegAngles upper{};
  LegRoles roles;

  /** @throws ModelError  unless the leg has six joints of its own: yaw, roll and two or three
   * pitches before the ankle, whose pitch and roll come last. */
  static LegChain read(const RobotModel& model, Leg leg);

  /** Pose of the sole in the root's frame. */
  Eigen::Isometry3d calc_sole(const LegAngles& angles) const;
};

}  // namespace nao
