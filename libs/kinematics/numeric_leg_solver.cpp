#include "kinematics/numeric_leg_solver.h"

#include <algorithm>

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
// Weights of an angle of the sole that the leg has no joint for, and of a joint's angle. Chosen:
// the errors that they leave in what the leg can keep, about their squares, do not show.
constexpr double kFreeWeight = 0.01;
constexpr double kRestWeight = 3e-3;
// The same norm for legs with such weights, and the change of the angles that ends a descent, rad.
constexpr double kNearlyReached = 2e-3;
constexpr double kNoChange = 1e-7;

/** Rotation vector of a rotation, rad. */
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

}  // namespace

NumericLegSolver::NumericLegSolver(const LegChain& chain, const LegAngles& start)
    : chain_(chain), start_(start), length_((chain.sole.translation() - chain.point[0]).norm()) {
  for (int i = 0; i < chain.num_joints(); ++i) {
    start_[i] = std::clamp(start_[i], chain.lower[i], chain.upper[i]);
  }
  if (chain.roles.ankle_roll < 0) weights_[0] = kFreeWeight;
  if (chain.roles.ankle_pitch < 0) weights_[1] = kFreeWeight;
  if (chain.roles.hip_yaw < 0) weights_[2] = kFreeWeight;
  is_exact_ = chain.num_joints() == 6 && weights_.minCoeff() == 1;
}

template <typename Rows>
void NumericLegSolver::weigh(const Eigen::Isometry3d& goal, Rows& rows) const {
  if (is_exact_) return;
  rows.template topRows<3>() = (goal.linear().transpose() * rows.template topRows<3>()).eval();
  rows = weights_.asDiagonal() * rows;
}

// Rotation vector and position from the present sole to the goal, both in T. Errors in position are
// divided by the leg's length, so that 1 rad and one leg length count equally.
NumericLegSolver::Vector6d NumericLegSolver::calc_error(const Eigen::Isometry3d& goal,
                                                        const LegAngles& angles) const {
  const Eigen::Isometry3d sole = chain_.calc_sole(angles);
  Vector6d error;
  error << rotation_vector(goal.linear() * sole.linear().transpose()),
      (goal.translation() - sole.translation()) / length_;
  weigh(goal, error);
  return error;
}

NumericLegSolver::Change NumericLegSolver::calc_rest(const LegAngles& angles) const {
  Change rest(chain_.num_joints());
  for (int i = 0; i < chain_.num_joints(); ++i) rest[i] = kRestWeight * (start_[i] - angles[i]);
  return rest;
}

double NumericLegSolver::squared_error(const Eigen::Isometry3d& goal,
                                       const LegAngles& angles) const {
  const double error = calc_error(goal, angles).squaredNorm();
  return is_exact_ ? error : error + calc_rest(angles).squaredNorm();
}

NumericLegSolver::Jacobian NumericLegSolver::calc_jacobian(const Eigen::Isometry3d& goal,
                                                           const LegAngles& angles) const {
  // Geometric Jacobian of the chain, column by column: axis, and axis x (sole - point on the axis).
  const Eigen::Vector3d sole = chain_.calc_sole(angles).translation();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Jacobian jacobian(6, chain_.num_joints());
  for (int i = 0; i < chain_.num_joints(); ++i) {
    const Eigen::Vector3d axis = rotation * chain_.axis[i];
    const Eigen::Vector3d point = rotation * chain_.point[i] + translation;
    jacobian.col(i) << axis, axis.cross(sole - point) / length_;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angles[i], chain_.axis[i]).toRotationMatrix();
    translation += rotation * (chain_.point[i] - turn * chain_.point[i]);
    rotation *= turn;
  }
  weigh(goal, jacobian);
  return jacobian;
}

// Levenberg-Marquardt with box constraints by projection: (J^T J + damping I) change = J^T error.
double NumericLegSolver::descend(const Eigen::Isometry3d& goal, LegAngles& angles) const {
  const int count = chain_.num_joints();
  Vector6d error = calc_error(goal, angles);
  double squared = squared_error(goal, angles);
  double damping = kFirstDamping;
  bool moves = true;
  for (int iteration = 0; iteration < kMaxIterations && error.norm() > kExact && moves;
       ++iteration) {
    Jacobian jacobian = calc_jacobian(goal, angles);
    Change rest = Change::Zero(count);
    if (!is_exact_) rest = kRestWeight * calc_rest(angles);
    // A joint at its limit whose gradient leads beyond it is held.
    const Change gradient = jacobian.transpose() * error + rest;
    for (int i = 0; i < count; ++i) {
      const bool is_held = (angles[i] <= chain_.lower[i] && gradient[i] < 0) ||
                           (angles[i] >= chain_.upper[i] && gradient[i] > 0);
      if (!is_held) continue;
      jacobian.col(i).setZero();
      rest[i] = 0;
    }
    Normal normal = jacobian.transpose() * jacobian;
    if (!is_exact_) normal.diagonal().array() += kRestWeight * kRestWeight;
    bool is_better = false;
    while (!is_better && damping <= kGreatestDamping) {
      Normal damped = normal;
      damped.diagonal().array() += damping;
      Change change = jacobian.transpose() * error + rest;
      solve_positive_definite(damped, change);
      LegAngles next = angles;
      for (int i = 0; i < count; ++i) {
        next[i] = std::clamp(angles[i] + change[i], chain_.lower[i], chain_.upper[i]);
      }
      // A step that does not lower the error is repeated with more damping, which shortens it and
      // turns it towards the gradient.
      const double next_squared = squared_error(goal, next);
      is_better = next_squared < squared;
      if (is_better) {
        angles = next;
        squared = next_squared;
        damping = std::max(kLeastDamping, damping * kLowered);
        moves = is_exact_ || change.norm() > kNoChange;
      } else {
        damping *= kRaised;
      }
    }
    // No damping helps: a local minimum.
    if (!is_better) break;
    error = calc_error(goal, angles);
  }
  // Only the rows that the leg can keep.
  return (weights_.array() == 1).select(error, Vector6d::Zero()).norm();
}

LegSolution NumericLegSolver::solve(const Eigen::Isometry3d& sole_in_torso) const {
  LegSolution solution;
  // The first descent starts from the ready posture; a leg that is stretched or at a limit there
  // may need another bend.
  solution.angles = start_;
  double least = descend(sole_in_torso, solution.angles);
  const double reached = is_exact_ ? kReached : kNearlyReached;
  for (const double bend : kKneeStarts) {
    if (least < reached) break;
    LegAngles angles = chain_.calc_bent(bend);
    const double error = descend(sole_in_torso, angles);
    if (error >= least) continue;
    least = error;
    solution.angles = angles;
  }
  // A pose that is not reached within tolerance gets the nearest one that was found.
  solution.is_reachable = least < reached;
  return solution;
}

}  // namespace nao
