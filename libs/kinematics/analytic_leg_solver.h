#pragma once

#include <optional>

#include "kinematics/leg_chain.h"

namespace nao {

/** Inverse kinematics in closed form of a leg whose three hip axes meet in a point and are
 * perpendicular to each other, in any order, whose knee and ankle pitch are parallel, and whose
 * ankle axes meet in a point below the hip's.
 *
 * At the angle 0 of all joints, with the hip h, a point k on the knee's axis, the ankle a, Y the
 * knee's and X the ankle roll's axis: A = h - k and B = k - a in the plane of X and Z = X x Y.
 *
 * 1. The distance d from hip to ankle gives the knee by the law of cosines:
 *        cos(angle(A) - angle(B) - q_knee) = (d^2 - |A|^2 - |B|^2) / (2 |A| |B|).
 * 2. The hip seen from the ankle in the foot's axes, u, gives the ankle: its roll turns u into the
 *    plane of thigh and tibia, its pitch is the angle between the two in that plane.
 * 3. The remaining rotation gives the hip as Euler angles about its three axes.
 *
 * The structure is that of LegKinematics, whose source it shares. Allocates no memory. */
class AnalyticLegSolver {
 public:
  /** @return Nothing if the leg is not built like that. */
  static std::optional<AnalyticLegSolver> make(const LegChain& chain);

  /** All angles, in (-pi, pi]; the joints' limits only decide which way the knee bends. */
  LegSolution solve(const Eigen::Isometry3d& sole_in_torso) const;

  /** Intersection of the hip axes at the angle 0 of all joints, m, root's frame. */
  const Eigen::Vector3d& hip() const { return hip_; }

 private:
  explicit AnalyticLegSolver(const LegChain& chain) : chain_(chain) {}

  /** Angle of a vector about Y, from Z towards X. */
  double angle_in_plane(const Eigen::Vector3d& vector) const;
  double solve_knee(double distance, bool& is_reachable) const;
  Eigen::Matrix3d turn(int joint, double angle) const {
    return Eigen::AngleAxisd(angle, chain_.axis[joint]).toRotationMatrix();
  }

  LegChain chain_;
  Eigen::Vector3d hip_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d ankle_ = Eigen::Vector3d::Zero();
  /** Position of the ankle in the sole's frame. */
  Eigen::Vector3d ankle_in_sole_ = Eigen::Vector3d::Zero();
  /** Columns X, Y, Z of the leg, and the hip's first two axes and their cross product. */
  Eigen::Matrix3d leg_axes_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d hip_axes_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d thigh_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d tibia_ = Eigen::Vector3d::Zero();
};

}  // namespace nao
