#include "daemons/head-camera/distortion.h"

#include <Eigen/LU>
#include <string>

#include "common/error.h"

namespace nao::camera {
namespace {

/** Newton's method converges quadratically: fewer than ten steps for every lens in use. */
constexpr int kMaxSteps = 20;
/** Error of the solution, focal lengths: far below a pixel. */
constexpr double kTolerance = 1e-12;

/** Derivative of distorted() by the point. */
Eigen::Matrix2d jacobian(const Distortion& d, const Eigen::Vector2d& point) {
  const double x = point.x();
  const double y = point.y();
  const double r2 = point.squaredNorm();
  // With r^2 = x^2 + y^2 and d(radial)/dx = 2 x d(radial)/d(r^2); the mixed derivatives are equal,
  // so that the Jacobian is symmetric.
  const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double radial_by_r2 = d.k1 + r2 * (2 * d.k2 + r2 * 3 * d.k3);
  const double mixed = 2 * x * y * radial_by_r2 + 2 * d.p1 * x + 2 * d.p2 * y;
  Eigen::Matrix2d matrix;
  matrix << radial + 2 * x * x * radial_by_r2 + 2 * d.p1 * y + 6 * d.p2 * x, mixed,  //
      mixed, radial + 2 * y * y * radial_by_r2 + 6 * d.p1 * y + 2 * d.p2 * x;
  return matrix;
}

}  // namespace

// Brown-Conrady model in OpenCV's order of coefficients, on normalized image coordinates.
Eigen::Vector2d distorted(const Distortion& d, const Eigen::Vector2d& point) {
  const double x = point.x();
  const double y = point.y();
  const double r2 = point.squaredNorm();
  const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  return {x * radial + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x),
          y * radial + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y};
}

Eigen::Vector2d undistorted(const Distortion& d, const Eigen::Vector2d& point) {
  Eigen::Vector2d solution = point;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Eigen::Matrix2d slope = jacobian(d, solution);
    // The symmetric Jacobian is positive definite unless the image folds over itself there.
    if (!(slope.determinant() > 0 && slope.trace() > 0)) break;
    const Eigen::Vector2d error = distorted(d, solution) - point;
    solution -= slope.inverse() * error;
    if (error.norm() < kTolerance) return solution;
  }
  std::string values;
  for (const double coefficient : d.coefficients()) values += " " + std::to_string(coefficient);
  throw ConfigError("the lens distortion (k1 k2 p1 p2 k3)" + values +
                    " folds the image over itself; choose values nearer to 0");
}

}  // namespace nao::camera
