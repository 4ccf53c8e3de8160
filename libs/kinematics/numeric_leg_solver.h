#pragma once

#include "kinematics/leg_chain.h"

namespace nao {

/** Inverse kinematics of any leg: damped least squares within the joints' limits.
 *
 * Each iteration solves (J^T J + lambda I) dq = J^T e for the error twist e of the sole, with the
 * joints that are at a limit and would leave it held. lambda falls while the error falls
 * (Levenberg-Marquardt). Deterministic: it always starts from the same angles. Allocates no memory.
 *
 * A leg that lacks a joint (yaw of the hip, pitch or roll of the ankle) keeps the sole's position
 * and the angles that it has joints for; the other ones follow, by low weights of their rows of J.
 * A leg with more than six joints takes the solution that is nearest to the start: rows
 * of low weight draw the angles there.
 *
 * Source: C. Wampler, "Manipulator inverse kinematic solutions based on vector formulations and
 * damped least-squares methods", IEEE Trans. Systems, Man, and Cybernetics 16(1), 1986. */
class NumericLegSolver {
 public:
  /** @param start  Angles to start from, such as those of a standing posture. */
  NumericLegSolver(const LegChain& chain, const LegAngles& start);

  /** Angles within the limits that put the sole there; exact to 1e-9 m and rad if a leg of six
   * joints reaches the pose, to 2e-3 rad and leg lengths for others. */
  LegSolution solve(const Eigen::Isometry3d& sole_in_torso) const;

 private:
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  /** (6 x joints), (joints x joints) and (joints). */
  using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxLegJoints>;
  using Normal =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxLegJoints, kMaxLegJoints>;
  using Change = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxLegJoints, 1>;

  /** One descent. @return Norm of the remaining error of what the leg can keep, with lengths in leg
   * lengths. */
  double descend(const Eigen::Isometry3d& goal, LegAngles& angles) const;
  /** Error twist of the sole and its Jacobian, weighted, lengths in leg lengths. */
  Vector6d calc_error(const Eigen::Isometry3d& goal, const LegAngles& angles) const;
  Jacobian calc_jacobian(const Eigen::Isometry3d& goal, const LegAngles& angles) const;
  /** Weights the rows of a twist or of a Jacobian in T, which it turns into the goal's axes. */
  template <typename Rows>
  void weigh(const Eigen::Isometry3d& goal, Rows& rows) const;
  /** Differences of the angles from the start, weighted, (joints). */
  Change calc_rest(const LegAngles& angles) const;
  double squared_error(const Eigen::Isometry3d& goal, const LegAngles& angles) const;

  LegChain chain_;
  LegAngles start_;
  /** Length of the leg, hip to sole, m. */
  double length_;
  /** Roll, pitch and yaw of the sole, then its position; all 1 for a leg of six joints. */
  Vector6d weights_ = Vector6d::Ones();
  bool is_exact_;
};

}  // namespace nao
