#pragma once

#include <Eigen/Core>

// Products of 3 x 3 matrices and vectors written out: a step computes hundreds, and the compiler
// does not inline Eigen's.

namespace nao::sim {

/** a x. */
[[gnu::always_inline]] inline Eigen::Vector3d product(const Eigen::Matrix3d& a,
                                                      const Eigen::Vector3d& x) {
  return {a(0, 0) * x[0] + a(0, 1) * x[1] + a(0, 2) * x[2],
          a(1, 0) * x[0] + a(1, 1) * x[1] + a(1, 2) * x[2],
          a(2, 0) * x[0] + a(2, 1) * x[1] + a(2, 2) * x[2]};
}

/** a b. */
[[gnu::always_inline]] inline Eigen::Matrix3d product(const Eigen::Matrix3d& a,
                                                      const Eigen::Matrix3d& b) {
  const Eigen::Vector3d x = product(a, Eigen::Vector3d(b(0, 0), b(1, 0), b(2, 0)));
  const Eigen::Vector3d y = product(a, Eigen::Vector3d(b(0, 1), b(1, 1), b(2, 1)));
  const Eigen::Vector3d z = product(a, Eigen::Vector3d(b(0, 2), b(1, 2), b(2, 2)));
  Eigen::Matrix3d result;
  result << x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2];
  return result;
}

/** r s r^T for a rotation r and a symmetric s. */
[[gnu::always_inline]] inline Eigen::Matrix3d rotated(const Eigen::Matrix3d& r,
                                                      const Eigen::Matrix3d& s) {
  const Eigen::Matrix3d half = product(r, s);
  const Eigen::Vector3d x = product(half, Eigen::Vector3d(r(0, 0), r(0, 1), r(0, 2)));
  const Eigen::Vector3d y = product(half, Eigen::Vector3d(r(1, 0), r(1, 1), r(1, 2)));
  const double zz = half(2, 0) * r(2, 0) + half(2, 1) * r(2, 1) + half(2, 2) * r(2, 2);
  Eigen::Matrix3d result;
  result << x[0], x[1], x[2], x[1], y[1], y[2], x[2], y[2], zz;
  return result;
}

}  // namespace nao::sim
