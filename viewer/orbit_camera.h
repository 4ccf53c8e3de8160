#pragma once

#include <Eigen/Geometry>

#include "rendering/pinhole_camera.h"

namespace nao::viewer {

/** A camera on a sphere around a target, which it looks at. */
struct OrbitCamera {
  /** m, in the world; by default the torso of a robot that stands at the origin. */
  Eigen::Vector3d target{0.1, 0, 0.27};
  /** Position as seen from the target: angle about z from x, and angle upwards, rad; distance, m.
   */
  double azimuth = 0.65;
  double elevation = 0.28;
  double distance = 1.5;

  /** Pose in the world: x along the view, y left, z up. Never below the floor. */
  Eigen::Isometry3d pose() const;

  /** Intrinsics for an image of this size, pixels. */
  PinholeCamera pinhole(int width, int height) const;

  /** Rotates by a mouse movement. @param du, dv  Pixels, to the right and down. */
  void rotate(double du, double dv);

  /** Moves the target with the mouse. @param du, dv  Pixels. @param height  Height of the image,
   * pixels.
   */
  void pan(double du, double dv, int height);

  /** @param steps  Steps of the mouse wheel; positive: nearer. */
  void zoom(double steps);
};

/** Intersection of a camera's ray with a horizontal plane.
 * @param pose_camera_in_world  Camera axes as OrbitCamera::pose(). @param height  Height of the
 * plane, m.
 * @param point  The intersection in the world, m.
 * @return false if the ray does not hit the plane in front of the camera. */
bool intersect_plane(const Eigen::Isometry3d& pose_camera_in_world,
                     const Eigen::Vector3d& ray_in_camera, double height, Eigen::Vector3d& point);

}  // namespace nao::viewer
