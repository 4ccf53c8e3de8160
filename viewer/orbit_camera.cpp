#include "viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace nao::viewer {
namespace {

/** rad; 40 degrees, a usual value of 3D viewers. */
constexpr double kVerticalFov = 0.7;
/** Least height of the camera above the floor, m. */
constexpr double kMinHeight = 0.02;
/** Rotation for each pixel of mouse movement, rad. Chosen: half a turn over 500 pixels. */
constexpr double kRotationPerPixel = 0.006;
/** Limits, rad: a little below the horizon of the target, and nearly from above, where the azimuth
 * is still defined. */
constexpr double kMinElevation = -0.2;
constexpr double kMaxElevation = 1.55;
/** Limit of the target's height, m: robots and goals are lower. */
constexpr double kMaxTargetHeight = 2.0;
/** Factor on the distance for each step of the wheel, and limits, m: from a single foot to the
 * whole field. */
constexpr double kZoomFactor = 0.9;
constexpr double kMinDistance = 0.2;
constexpr double kMaxDistance = 25.0;

}  // namespace

Eigen::Isometry3d OrbitCamera::pose() const {
  const Eigen::Vector3d out(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d x = -out;
  const Eigen::Vector3d y(std::sin(azimuth), -std::cos(azimuth), 0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << x, y, x.cross(y);
  pose.translation() = target + distance * out;
  pose.translation().z() = std::max(pose.translation().z(), kMinHeight);
  return pose;
}

PinholeCamera OrbitCamera::pinhole(int width, int height) const {
  const double aspect = static_cast<double>(width) / height;
  return PinholeCamera::from_fov(width, height, 2 * std::atan(aspect * std::tan(kVerticalFov / 2)),
                                 kVerticalFov);
}

void OrbitCamera::rotate(double du, double dv) {
  azimuth -= kRotationPerPixel * du;
  elevation = std::clamp(elevation + kRotationPerPixel * dv, kMinElevation, kMaxElevation);
}

void OrbitCamera::pan(double du, double dv, int height) {
  // Meters for each pixel at the distance of the target.
  const double scale = 2 * distance * std::tan(kVerticalFov / 2) / height;
  const Eigen::Matrix3d axes = pose().linear();
  target += scale * (du * axes.col(1) + dv * axes.col(2));
  target.z() = std::clamp(target.z(), 0.0, kMaxTargetHeight);
}

void OrbitCamera::zoom(double steps) {
  distance = std::clamp(distance * std::pow(kZoomFactor, steps), kMinDistance, kMaxDistance);
}

bool intersect_plane(const Eigen::Isometry3d& pose_camera_in_world,
                     const Eigen::Vector3d& ray_in_camera, double height, Eigen::Vector3d& point) {
  const Eigen::Vector3d ray = pose_camera_in_world.linear() * ray_in_camera;
  const double factor = (height - pose_camera_in_world.translation().z()) / ray.z();
  point = pose_camera_in_world.translation() + factor * ray;
  return std::isfinite(factor) && factor > 0;
}

}  // namespace nao::viewer
