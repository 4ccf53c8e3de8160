#pragma once

#include <Eigen/Geometry>
#include <array>

namespace nao {

/** Ideal camera without distortion. Camera axes: x along the view, y left, z up. Pixel (0, 0) is
 * the centre of the upper left pixel; u runs right, v down. */
struct PinholeCamera {
  /** Picture size, pixels. */
  int width = 0;
  int height = 0;
  /** Focal lengths and principal point, pixels. */
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;

  /** Camera with its principal point in the middle. @param horizontal_fov, vertical_fov  rad. */
  static PinholeCamera from_fov(int width, int height, double horizontal_fov, double vertical_fov);

  /** The same camera with a picture of another width, its pixels larger or smaller. */
  PinholeCamera resized(int new_width) const;

  /** Pixel that shows a point given in the camera's frame, m; x must be above 0. */
  Eigen::Vector2d project(const Eigen::Vector3d& point_in_camera) const;

  /** Point on the ray through a pixel, 1 m ahead along x, in the camera's frame. */
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

/** OpenGL's clip coordinates from its eye coordinates. @param near, far  m along the view. */
Eigen::Matrix4f projection_matrix(const PinholeCamera& camera, double near, double far);

/** OpenGL's eye coordinates (x right, y up, z backwards) from the world, for a camera there. */
Eigen::Matrix4f view_matrix(const Eigen::Isometry3d& pose_camera_in_world);

/** The part of space that a camera sees. */
class Frustum {
 public:
  /** @param clip_from_world  projection_matrix() * view_matrix(). */
  explicit Frustum(const Eigen::Matrix4f& clip_from_world);

  /** False only if no part of the sphere (m, in the world) can be seen. */
  bool may_see(const Eigen::Vector3f& center, float radius) const;

  /** The same for all spheres along the way from one place to another. */
  bool may_see(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius) const;

 private:
  /** Planes as (inward unit normal, offset). */
  std::array<Eigen::Vector4f, 6> planes_;
};

}  // namespace nao
