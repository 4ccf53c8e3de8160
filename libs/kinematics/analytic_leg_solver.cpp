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
  // Each line's equation is (I - a a^T)(x - p) = 0: the part of x - p across its axis.
  // Least squares: sum of (I - a a^T)(x - p) = 0.
  Matrix3d sum = Matrix3d::Zero();
  Vector3d moment = Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Matrix3d across = Matrix3d::Identity() - chain.axis[i] * chain.axis[i].transpose();
    sum += across;
    moment += across * chain.point[i];
  }
  point = sum.inverse() * moment;
  // Distance of the solution from each line: skew axes have a least-squares point, but no common
  // one.
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
  // Three hip axes that are perpendicular to one another and meet (a ball joint), and a knee
  // parallel to the ankle's pitch: then position and orientation separate (Pieper's condition).
  if (chain.num_joints() != 6) return std::nullopt;
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

  // Bases of the foot (roll, pitch, and their cross product: along the leg) and of the hip. Both in
  // T at the angles 0.
  solver.leg_axes_ << axis[5], axis[3], axis[5].cross(axis[3]);
  solver.hip_axes_ << axis[0], axis[1], axis[0].cross(axis[1]);
  const Vector3d& knee = chain.point[3];
  // Hip and ankle must be in one plane across the knee's axis; otherwise thigh and tibia do not
  // form a planar two-link arm.
  if (std::abs((solver.hip_ - solver.ankle_).dot(axis[3])) > kLegTolerance) return std::nullopt;
  const Matrix3d in_plane = Matrix3d::Identity() - axis[3] * axis[3].transpose();
  solver.thigh_ = in_plane * (solver.hip_ - knee);
  solver.tibia_ = in_plane * (knee - solver.ankle_);
  if (solver.thigh_.norm() < kLegTolerance || solver.tibia_.norm() < kLegTolerance)
    return std::nullopt;
  return solver;
}

// Angle of a vector about the pitch axis, from the leg's direction, rad.
double AnalyticLegSolver::angle_in_plane(const Vector3d& vector) const {
  return std::atan2(leg_axes_.col(0).dot(vector), leg_axes_.col(2).dot(vector));
}

double AnalyticLegSolver::solve_knee(double distance, bool& is_reachable) const {
  const double bend = knee_bend(thigh_.norm(), tibia_.norm(), distance, is_reachable);
  // Knee angle of a straight leg: 0 only if thigh and tibia are in line at the angles 0.
  const double straight = angle_in_plane(thigh_) - angle_in_plane(tibia_);
  // Take the solution nearer to the middle of the knee's range, or of the half in which it bends.
  double middle = 0.5 * (chain_.lower[3] + chain_.upper[3]);
  if (middle * chain_.bend_sign <= 0) {
    middle = 0.5 * (chain_.bend_sign > 0 ? chain_.upper[3] : chain_.lower[3]);
  }
  const double up = wrapped(straight + bend);
  const double down = wrapped(straight - bend);
  return std::abs(up - middle) <= std::abs(down - middle) ? up : down;
}

LegSolution AnalyticLegSolver::solve(const Eigen::Isometry3d& sole_in_torso) const {
  LegSolution solution;
  LegAngles& q = solution.angles;
  // Rotation of the foot since the angle 0, and the hip seen from the ankle in the foot's axes.
  // The foot's rotation R and the ankle give all angles from the ankle upwards: knee by the
  // distance, roll and pitch of the ankle by the hip's direction, and the hip by the rest of R.
  const Matrix3d rotation = sole_in_torso.linear() * chain_.sole.linear().transpose();
  const Vector3d to_hip = rotation.transpose() * (hip_ - sole_in_torso * ankle_in_sole_);
  q[3] = solve_knee(to_hip.norm(), solution.is_reachable);

  // Roll turns the hip into the plane of the leg: the component along the pitch axis becomes 0.
  const Vector3d u = leg_axes_.transpose() * to_hip;
  // Take the solution with |roll| below 90 degrees, even if the hip of a folded leg is below the
  // ankle.
  const double up = std::copysign(std::hypot(u.y(), u.z()), u.z());
  q[5] = std::atan2(u.y() / up, u.z() / up);
  // Hip seen from the ankle with the knee bent, in the plane of the leg; pitch turns it onto u.
  const Vector3d leg = turn(3, -q[3]) * thigh_ + tibia_;
  const double side = chain_.axis[4].dot(chain_.axis[3]) > 0 ? 1 : -1;
  q[4] = wrapped(side * (angle_in_plane(leg) - std::atan2(u.x(), up)));

  // R = R_hip R_knee R_ankle: rotation of the three hip joints.
  const Matrix3d hip = rotation * turn(5, -q[5]) * turn(4, -q[4]) * turn(3, -q[3]);
  // In the hip's basis it is Rx(q0) Ry(q1) Rz(+-q2), whose angles are in the first row and last
  // column.
  const Matrix3d m = hip_axes_.transpose() * hip * hip_axes_;
  q[0] = std::atan2(-m(1, 2), m(2, 2));
  q[1] = std::asin(std::clamp(m(0, 2), -1.0, 1.0));
  const double sign = hip_axes_.col(2).dot(chain_.axis[2]) > 0 ? 1 : -1;
  q[2] = sign * std::atan2(-m(0, 1), m(0, 0));
  return solution;
}

}  // namespace nao
