#include "kinematics/numeric_leg_solver.h"

#include <algorithm>
#include <cmath>

#include "common/linear_solver.h"

namespace nao {
namespace {

// Greatest number of iterations, which bounds the time for an unreachable pose.
constexpr int kMaxIterations = 60;
// Norm of the error, in rad and leg lengths, below which the sole has reached its pose; and the one
// below which a descent that has stopped still counts as having reached it.
constexpr double kExact = 1e-10;
constexpr double kReached = 1e-7;
// Damping: at first, least and greatest; factors after an iteration that lowered or raised the
// error. Chosen: usual values of Levenberg-Marquardt for angles in rad.
constexpr double kFirstDamping = 1e-3;
constexpr double kLeastDamping = 1e-12;
constexpr double kGreatestDamping = 1e3;
constexpr double kLowered = 0.1;
constexpr double kRaised = 8;
// Bends of the knee from which further descents start if the first one does not reach, rad.
constexpr double kKneeStarts[] = {0.3, 1.0, 1.7};

/** Rotation vector of a rotation, rad. */
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

}  // namespace

NumericLegSolver::NumericLegSolver(const LegChain& chain, const LegAngles& start)
    : chain_(chain), start_(start), length_((chain.sole.translation() - chain.point[0]).norm()) {
  for (size_t i = 0; i < start_.size(); ++i) {
    start_[i] = std::clamp(start_[i], chain.lower[i], chain.upper[i]);
  }
}

// Rotation vector and position from the present sole to the goal, both in T. Errors in position are
// divided by the leg's length, so that 1 rad and one leg length count equally.
NumericLegSolver::Vector6d NumericLegSolver::calc_error(const Eigen::Isometry3d& goal,
                                                        const LegAngles& angles) const {
  const Eigen::Isometry3d sole = chain_.calc_sole(angles);
  Vector6d error;
  error << rotation_vector(goal.linear() * sole.linear().transpose()),
      (goal.translation() - sole.translation()) / length_;
  return error;
}

NumericLegSolver::Matrix6d NumericLegSolver::calc_jacobian(const LegAngles& angles) const {
  // Geometric Jacobian of the chain, column by column: axis, and axis x (sole - point on the axis).
  const Eigen::Vector3d sole = chain_.calc_sole(angles).translation();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Matrix6d jacobian;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d axis = rotation * chain_.axis[i];
    const Eigen::Vector3d point = rotation * chain_.point[i] + translation;
    jacobian.col(i) << axis, axis.cross(sole - point) / length_;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angles[i], chain_.axis[i]).toRotationMatrix();
    translation += rotation * (chain_.point[i] - turn * chain_.point[i]);
    rotation *= turn;
  }
  return jacobian;
}

// Levenberg-Marquardt with box constraints by projection: (J^T J + damping I) change = J^T error.
// Returns the norm of the remaining error.
double NumericLegSolver::descend(const Eigen::Isometry3d& goal, LegAngles& angles) const {
  Vector6d error = calc_error(goal, angles);
  double damping = kFirstDamping;
  for (int iteration = 0; iteration < kMaxIterations && error.norm() > kExact; ++iteration) {
    Matrix6d jacobian = calc_jacobian(angles);
    // A joint at its limit whose gradient leads beyond it is held.
    const Vector6d gradient = jacobian.transpose() * error;
    for (int i = 0; i < 6; ++i) {
      const bool is_held = (angles[i] <= chain_.lower[i] && gradient[i] < 0) ||
                           (angles[i] >= chain_.upper[i] && gradient[i] > 0);
      if (is_held) jacobian.col(i).setZero();
    }
    Matrix6d normal = jacobian.transpose() * jacobian;
    bool is_better = false;
    while (!is_better && damping <= kGreatestDamping) {
      Matrix6d damped = normal;
      damped.diagonal().array() += damping;
      Vector6d change = jacobian.transpose() * error;
      solve_positive_definite(damped, change);
      LegAngles next = angles;
      for (int i = 0; i < 6; ++i) {
        next[i] = std::clamp(angles[i] + change[i], chain_.lower[i], chain_.upper[i]);
      }
      // A step that does not lower the error is repeated with more damping, which shortens it and
      // turns it towards the gradient.
      const Vector6d next_error = calc_error(goal, next);
      is_better = next_error.squaredNorm() < error.squaredNorm();
      if (is_better) {
        angles = next;
        error = next_error;
        damping = std::max(kLeastDamping, damping * kLowered);
      } else {
        damping *= kRaised;
      }
    }
    // No damping helps: a local minimum.
    if (!is_better) break;
  }
  return error.norm();
}

LegSolution NumericLegSolver::solve(const Eigen::Isometry3d& sole_in_torso) const {
  LegSolution solution;
  // The first descent starts from the ready posture; a leg that is stretched or at a limit there
  // may need another bend.
  solution.angles = start_;
  double least = descend(sole_in_torso, solution.angles);
  const LegRoles& roles = chain_.roles;
  for (const double bend : kKneeStarts) {
    if (least < kReached) break;
    // The knee bends towards the farther one of its limits; hip and ankle pitch keep the sole
    // level.
    const bool bends_up = chain_.upper[roles.knee] > -chain_.lower[roles.knee];
    const double knee = (bends_up ? 1 : -1) * bend;
    LegAngles angles{};
    angles[roles.knee] = knee;
    angles[roles.hip_pitch] = -0.5 * knee * roles.sign[roles.knee] * roles.sign[roles.hip_pitch];
    angles[roles.ankle_pitch] =
        -0.5 * knee * roles.sign[roles.knee] * roles.sign[roles.ankle_pitch];
    for (int i = 0; i < 6; ++i) {
      angles[i] = std::clamp(angles[i], chain_.lower[i], chain_.upper[i]);
    }
    const double error = descend(sole_in_torso, angles);
    if (error >= least) continue;
    least = error;
    solution.angles = angles;
  }
  // A pose that is not reached within tolerance gets the nearest one that was found.
  solution.is_reachable = least < kReached;
  return solution;
}

}  // namespace nao
