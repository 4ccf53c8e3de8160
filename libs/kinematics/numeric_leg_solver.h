#pragma once

#include "kinematics/leg_chain.h"

namespace nao {

/** Inverse kinematics of any leg of six joints: damped least squares within the joints' limits.
 *
 * Each iteration solves (J^T J + lambda I) dq = J^T e for the error twist e of the sole, with the
 * joints that are at a limit and would leave it held. lambda falls while the error falls
 * (Levenberg-Marquardt). Deterministic: it always starts from the same angles. Allocates no memory.
 *
 * Source: C. Wampler, "Manipulator inverse kinematic solutions based on vector formulations and
 * damped least-squares methods", IEEE Trans. Systems, Man, and Cybernetics 16(1), 1986. */
class NumericLegSolver {
 public:
  /** @param start  Angles to start from, such as those of a standing posture. */
  NumericLegSolver(const LegChain& chain, const LegAngles& start);

  /** Angles within the limits that put the sole there; exact to 1e-9 m and rad if the leg reaches
   * the pose. */
  LegSolution solve(const Eigen::Isometry3d& sole_in_torso) const;

 private:
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  /** One descent. @return Norm of the remaining error, with lengths in leg lengths. */
  double descend(const Eigen::Isometry3d& goal, LegAngles& angles) const;
  /** Error twist of the sole and its Jacobian, lengths in leg lengths. */
  Vector6d calc_error(const Eigen::Isometry3d& goal, const LegAngles& angles) const;
  Matrix6d calc_jacobian(const LegAngles& angles) const;

  LegChain chain_;
  LegAngles start_;
  /** Length of the leg, hip to sole, m. */
  double length_;
};

}  // namespace nao
