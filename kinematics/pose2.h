#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace nao {

/** An angle's equal in (-pi, pi], rad. */
inline double wrapped(double angle) {
  return std::remainder(angle, 2 * M_PI);
}

/** Where something stands on the ground and where it looks: m, rad. */
struct Pose2 {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading = 0;

  /** Re-expresses a direction given in this frame in the one that this pose is given in. */
  Eigen::Vector2d rotate(const Eigen::Vector2d& direction) const {
    return Eigen::Rotation2Dd(heading) * direction;
  }
  /** A point of this frame, seen from the frame that this pose is given in. */
  Eigen::Vector2d operator*(const Eigen::Vector2d& point) const { return position + rotate(point); }
  Pose2 operator*(const Pose2& inner) const {
    return {*this * inner.position, heading + inner.heading};
  }
  Pose2 inverse() const {
    return {Eigen::Rotation2Dd(-heading) * Eigen::Vector2d(-position), -heading};
  }

  /** Ground projection of a pose in space: its origin and where its x axis points. */
  static Pose2 from(const Eigen::Isometry3d& pose) {
    const Eigen::Matrix3d R = pose.linear();
    return {pose.translation().head<2>(), std::atan2(R(1, 0), R(0, 0))};
  }
};

}  // namespace nao
