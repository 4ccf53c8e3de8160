#include "kinematics/analytic_leg_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kinematics/knee_bend.h"
#include "kinematics/leg_tolerances.h"
#include "kinematics/pose2.h"

namespace nao {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** A point that three lines share. @return false if they do not meet. */
bool find_intersection(const LegChain& chain, Vector3d& point) {
  // Least squares: sum of (I - a a^T)(x - p) = 0.
  Matrix3d sum = Matrix3d::Zero();
  Vector3d moment = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Matrix3d across = Matrix3d::Identity() - chain.axis[i] * chain.axis[i].transpose();
    sum += across;
    moment += across * chain.point[i];
  }
  point = sum.inverse() * moment;
  for (int i = 0; i < 3; ++i) {
    if ((point - chain.point[i]).cross(chain.axis[i]).norm() > kLegTolerance) return false;
  }
  return true;
}

bool are_perpendicular(const Vector3d& a, const Vector3d& b) {
  return std::abs(a.dot(b)) < kLegTolerance;
}

}  // namespace

std::optional<AnalyticLegSolver> AnalyticLegSolver::make(const LegChain& chain) {
  const auto& axis = chain.axis;
  const bool is_hip = are_perpendicular(axis[0], axis[1]) && are_perpendicular(axis[1], axis[2]) &&
                      are_perpendicular(axis[0], axis[2]);
  const bool is_leg =
      axis[3].cross(axis[4]).norm() < kLegTolerance && are_perpendicular(axis[4], axis[5]);
  AnalyticLegSolver solver(chain);
  if (!is_hip || !is_leg || !find_intersection(chain, solver.hip_)) return std::nullopt;

  // The ankle: where the roll axis meets the pitch axis.
  const Vector3d normal = axis[4].cross(axis[5]);
  const Vector3d between = chain.point[5] - chain.point[4];
  if (std::abs(between.dot(normal)) > kLegTolerance) return std::nullopt;
  solver.ankle_ = chain.point[4] + between.dot(axis[4]) * axis[4];
  solver.ankle_in_sole_ = chain.sole.inverse() * solver.ankle_;

  solver.leg_axes_ << axis[5], axis[3], axis[5].cross(axis[3]);
  solver.hip_axes_ << axis[0], axis[1], axis[0].cross(axis[1]);
  const Vector3d& knee = chain.point[3];
  if (std::abs((solver.hip_ - solver.ankle_).dot(axis[3])) > kLegTolerance) return std::nullopt;
  const Matrix3d in_plane = Matrix3d::Identity() - axis[3] * axis[3].transpose();
  solver.thigh_ = in_plane * (solver.hip_ - knee);
  solver.tibia_ = in_plane * (knee - solver.ankle_);
  if (solver.thigh_.norm() < kLegTolerance || solver.tibia_.norm() < kLegTolerance)
    return std::nullopt;
  return solver;
}

double AnalyticLegSolver::angle_in_plane(const Vector3d& vector) const {
  return std::atan2(leg_axes_.col(0).dot(vector), leg_axes_.col(2).dot(vector));
}

double AnalyticLegSolver::solve_knee(double distance, bool& is_reachable) const {
  const double bend = knee_bend(thigh_.norm(), tibia_.norm(), distance, is_reachable);
  const double straight = angle_in_plane(thigh_) - angle_in_plane(tibia_);
  // Of the two solutions the one that is nearer to the middle of the knee's range.
  const double middle = 0.5 * (chain_.lower[3] + chain_.upper[3]);
  const double up = wrapped(straight + bend);
  const double down = wrapped(straight - bend);
  return std::abs(up - middle) <= std::abs(down - middle) ? up : down;
}

LegSolution AnalyticLegSolver::solve(const Eigen::Isometry3d& sole_in_torso) const {
  LegSolution solution;
  LegAngles& q = solution.angles;
  // Rotation of the foot since the angle 0, and the hip seen from the ankle in the foot's axes.
  const Matrix3d rotation = sole_in_torso.linear() * chain_.sole.linear().transpose();
  const Vector3d to_hip = rotation.transpose() * (hip_ - sole_in_torso * ankle_in_sole_);
  q[3] = solve_knee(to_hip.norm(), solution.is_reachable);

  const Vector3d u = leg_axes_.transpose() * to_hip;
  // Of the two solutions the one with |roll| below 90 degrees, also if the hip of a folded leg is
  // below the ankle.
  const double up = std::copysign(std::hypot(u.y(), u.z()), u.z());
  q[5] = std::atan2(u.y() / up, u.z() / up);
  const Vector3d leg = turn(3, -q[3]) * thigh_ + tibia_;
  const double side = chain_.axis[4].dot(chain_.axis[3]) > 0 ? 1 : -1;
  q[4] = wrapped(side * (angle_in_plane(leg) - std::atan2(u.x(), up)));

  const Matrix3d hip = rotation * turn(5, -q[5]) * turn(4, -q[4]) * turn(3, -q[3]);
  const Matrix3d m = hip_axes_.transpose() * hip * hip_axes_;
  q[0] = std::atan2(-m(1, 2), m(2, 2));
  q[1] = std::asin(std::clamp(m(0, 2), -1.0, 1.0));
  const double sign = hip_axes_.col(2).dot(chain_.axis[2]) > 0 ? 1 : -1;
  q[2] = sign * std::atan2(-m(0, 1), m(0, 0));
  return solution;
}

}  // namespace nao
