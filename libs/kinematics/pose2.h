#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace nao {

/** The equal angle in [-pi, pi], rad. */
inline double wrapped(double angle) {
  return std::remainder(angle, 2 * M_PI);
}

/** Angle of a rotation's x axis about z, rad. */
inline double heading_of(const Eigen::Matrix3d& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

/** A pose on the ground, as a transform between two frames: position, m, and heading, rad. */
struct Pose2 {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading = 0;

  /** Re-expresses a direction given in the inner frame in the outer one. */
  Eigen::Vector2d rotate(const Eigen::Vector2d& direction) const {
    return Eigen::Rotation2Dd(heading) * direction;
  }
  /** A point of the inner frame, expressed in the outer one. */
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const { return position + rotate(point); }
  Pose2 operator*(const Pose2& inner) const {
    return {*this * inner.position, heading + inner.heading};
  }
  Pose2 inverse() const {
    return {Eigen::Rotation2Dd(-heading) * Eigen::Vector2d(-position), -heading};
  }

  /** Ground projection of a pose in space: its origin and the direction of its x axis. */
  static Pose2 from(const Eigen::Isometry3d& pose) {
    return {pose.translation().head<2>(), heading_of(pose.linear())};
  }
};

}  // namespace nao
