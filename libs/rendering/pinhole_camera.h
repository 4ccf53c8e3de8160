#pragma once

#include <Eigen/Geometry>
#include <array>

namespace nao {

/** Pinhole camera without distortion. Camera axes: x along the view, y left, z up. Pixel (0, 0) is
 * the center of the upper left pixel; u runs right, v down. */
struct PinholeCamera {
  /** Image size, pixels. */
  int width = 0;
  int height = 0;
  /** Focal lengths and principal point, pixels. */
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;

  /** Camera with its principal point at the center of the image.
   * @param horizontal_fov, vertical_fov  rad, between the outer edges of the outermost pixels. */
  static PinholeCamera from_fov(int width, int height, double horizontal_fov, double vertical_fov);

  /** The same camera with an image of another resolution and the same field of view. */
  PinholeCamera resized(int new_width) const;

  /** Pixel coordinates of a point in the camera frame, m; its x must be above 0. */
  Eigen::Vector2d project(const Eigen::Vector3d& point_in_camera) const;

  /** Point with x = 1 m on the ray through a pixel, in the camera frame. */
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

/** From OpenGL's eye coordinates to its clip coordinates.
 * @param near, far  Distances of the clipping planes along the view, m. */
Eigen::Matrix4f projection_matrix(const PinholeCamera& camera, double near, double far);

/** From the world to OpenGL's eye coordinates (x right, y up, z backwards). */
Eigen::Matrix4f view_matrix(const Eigen::Isometry3d& pose_camera_in_world);

/** The part of space that is visible to a camera. */
class Frustum {
 public:
  /** @param clip_from_world  projection_matrix() * view_matrix(). */
  explicit Frustum(const Eigen::Matrix4f& clip_from_world);

  /** @return false only if no part of the sphere (m, in the world) is visible. */
  bool may_see(const Eigen::Vector3f& center, float radius) const;

  /** @return false only if no part of any sphere with its center on the segment is visible. */
  bool may_see(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius) const;

 private:
  /** Planes as (inward unit normal, offset). */
  std::array<Eigen::Vector4f, 6> planes_;
};

}  // namespace nao
