#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rendering/pinhole_camera.h"

namespace nao {

/** A camera that circles a point and looks at it. */
struct OrbitCamera {
  /** m, in the world. */
  Eigen::Vector3d target{0.1, 0, 0.27};
  /** Where the camera stands as seen from the target: rad about z from x, and upwards; m. */
  double azimuth = 0.65;
  double elevation = 0.28;
  double distance = 1.5;

  /** rad. */
  static constexpr double kVerticalFov = 0.7;

  Eigen::Isometry3d pose() const {
    const Eigen::Vector3d out(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const Eigen::Vector3d x = -out;
    const Eigen::Vector3d y(std::sin(azimuth), -std::cos(azimuth), 0);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << x, y, x.cross(y);
    pose.translation() = target + distance * out;
    // Never under the floor.
    pose.translation().z() = std::max(pose.translation().z(), 0.02);
    return pose;
  }

  PinholeCamera pinhole(int width, int height) const {
    const double aspect = static_cast<double>(width) / height;
    return PinholeCamera::from_fov(
        width, height, 2 * std::atan(aspect * std::tan(kVerticalFov / 2)), kVerticalFov);
  }

  /** Turns by a drag of the mouse. @param du, dv  Pixels, to the right and down. */
  void rotate(double du, double dv) {
    azimuth -= 0.006 * du;
    elevation = std::clamp(elevation + 0.006 * dv, -0.2, 1.55);
  }

  /** Moves the target so that it follows the mouse. @param height  Of the picture, pixels. */
  void pan(double du, double dv, int height) {
    const double scale = 2 * distance * std::tan(kVerticalFov / 2) / height;
    const Eigen::Matrix3d axes = pose().linear();
    target += scale * (du * axes.col(1) + dv * axes.col(2));
    target.z() = std::clamp(target.z(), 0.0, 2.0);
  }

  /** @param steps  Of the mouse wheel; positive comes nearer. */
  void zoom(double steps) { distance = std::clamp(distance * std::pow(0.9, steps), 0.2, 25.0); }
};

/** Where a ray from a camera through a pixel meets the plane at a height, m; false if it does not.
 */
inline bool meets_plane(const Eigen::Isometry3d& pose, const Eigen::Vector3d& ray_in_camera,
                        double height, Eigen::Vector3d& point) {
  const Eigen::Vector3d ray = pose.linear() * ray_in_camera;
  const double way = (height - pose.translation().z()) / ray.z();
  point = pose.translation() + way * ray;
  return std::isfinite(way) && way > 0;
}

}  // namespace nao
