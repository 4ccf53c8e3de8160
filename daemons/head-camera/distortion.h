#pragma once

#include <Eigen/Core>
#include <array>

namespace nao::camera {

/** Coefficients of the lens distortion, no unit; all 0: an ideal pinhole camera. */
struct Distortion {
  /** Radial; k1 below 0 is a barrel, above 0 a pincushion. */
  double k1 = 0;
  double k2 = 0;
  /** Tangential. */
  double p1 = 0;
  double p2 = 0;
  /** Radial, of the highest order. */
  double k3 = 0;

  /** k1, k2, p1, p2, k3: OpenCV's order, and that of image_t. */
  std::array<double, 5> coefficients() const { return {k1, k2, p1, p2, k3}; }
  bool is_zero() const { return coefficients() == std::array<double, 5>{}; }
};

/** Applies the Brown-Conrady model (Brown, "Close-range camera calibration", 1971) as OpenCV
 * defines it (calib3d, "Camera calibration and 3D reconstruction"):
 *
 *     x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)
 *     y' = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y,   r^2 = x^2 + y^2
 *
 * @param point  In the image plane at distance 1: x right, y down, in focal lengths from the
 *   principal point. @return The same for the distorted image; its pixel is (cx + fx x', cy + fy
 * y').
 */
Eigen::Vector2d distorted(const Distortion& distortion, const Eigen::Vector2d& point);

/** Inverse of distorted().
 * @throws ConfigError  if the distortion maps two points to this one, or is near to that: the image
 *   would fold over itself. */
Eigen::Vector2d undistorted(const Distortion& distortion, const Eigen::Vector2d& point);

}  // namespace nao::camera
