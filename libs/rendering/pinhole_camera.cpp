#include "rendering/pinhole_camera.h"

#include <algorithm>
#include <cmath>

namespace nao {

PinholeCamera PinholeCamera::from_fov(int width, int height, double horizontal_fov,
                                      double vertical_fov) {
  PinholeCamera camera;
  camera.width = width;
  camera.height = height;
  // tan(fov / 2) = (size / 2) / f.
  camera.fx = width / 2.0 / std::tan(horizontal_fov / 2);
  camera.fy = height / 2.0 / std::tan(vertical_fov / 2);
  // Pixel centers are at whole numbers: the middle of the image is between the two middle ones.
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  return camera;
}

PinholeCamera PinholeCamera::resized(int new_width) const {
  const double scale = static_cast<double>(new_width) / width;
  PinholeCamera camera;
  camera.width = new_width;
  camera.height = static_cast<int>(std::lround(height * scale));
  camera.fx = fx * scale;
  camera.fy = fy * scale;
  // The center of the first pixel lies half a pixel inside of the corner of the image.
  camera.cx = (cx + 0.5) * scale - 0.5;
  camera.cy = (cy + 0.5) * scale - 0.5;
  return camera;
}

// The camera looks along x, y is to the left and z up: u = cx - fx y / x, v = cy - fy z / x.
Eigen::Vector2d PinholeCamera::project(const Eigen::Vector3d& point_in_camera) const {
  return {cx - fx * point_in_camera.y() / point_in_camera.x(),
          cy - fy * point_in_camera.z() / point_in_camera.x()};
}

Eigen::Vector3d PinholeCamera::ray(const Eigen::Vector2d& pixel) const {
  return {1, (cx - pixel.x()) / fx, (cy - pixel.y()) / fy};
}

// OpenGL's projection (Khronos, glFrustum) with the intrinsics in place of the planes: eye
// coordinates look along -z, clip coordinates are -1 to 1.
Eigen::Matrix4f projection_matrix(const PinholeCamera& camera, double near, double far) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  matrix(0, 0) = 2 * camera.fx / camera.width;
  // +0.5: OpenGL measures from the corner of the first pixel, the camera from its center.
  matrix(0, 2) = 1 - 2 * (camera.cx + 0.5) / camera.width;
  matrix(1, 1) = 2 * camera.fy / camera.height;
  matrix(1, 2) = 2 * (camera.cy + 0.5) / camera.height - 1;
  matrix(2, 2) = -(far + near) / (far - near);
  matrix(2, 3) = -2 * far * near / (far - near);
  matrix(3, 2) = -1;
  return matrix.cast<float>();
}

// Camera axes (x forward, y left, z up) to OpenGL's eye axes (x right, y up, z backward).
Eigen::Matrix4f view_matrix(const Eigen::Isometry3d& pose_camera_in_world) {
  Eigen::Matrix4d eye_from_camera;
  eye_from_camera << 0, -1, 0, 0,  //
      0, 0, 1, 0,                  //
      -1, 0, 0, 0,                 //
      0, 0, 0, 1;
  return (eye_from_camera * pose_camera_in_world.inverse().matrix()).cast<float>();
}

Frustum::Frustum(const Eigen::Matrix4f& clip_from_world) {
  // A point is inside if -w <= x, y, z <= w in clip coordinates: six planes, each the sum or
  // difference of two rows of the matrix (Gribb and Hartmann, 2001).
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const float sign = side == 0 ? 1 : -1;
      Eigen::Vector4f plane = clip_from_world.row(3) + sign * clip_from_world.row(axis);
      plane /= plane.head<3>().norm();
      planes_[2 * axis + side] = plane;
    }
  }
}

// A sphere is outside if it lies wholly behind one plane. Spheres near the frustum's edges may pass
// although they are not seen: that costs time only.
bool Frustum::may_see(const Eigen::Vector3f& center, float radius) const {
  return may_see(center, center, radius);
}

bool Frustum::may_see(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius) const {
  for (const Eigen::Vector4f& plane : planes_) {
    // A capsule: its end that is farther inside decides.
    const float nearest = std::max(plane.head<3>().dot(from), plane.head<3>().dot(to));
    if (nearest + plane.w() < -radius) return false;
  }
  return true;
}

}  // namespace nao
