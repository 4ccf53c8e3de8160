#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nao {

namespace detail {

template <class Scalar>
Eigen::Quaternion<Scalar> shortest_rotation(const Eigen::Matrix<Scalar, 3, 1>& from,
                                            const Eigen::Matrix<Scalar, 3, 1>& to) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Vector a = from.normalized();
  const Vector b = to.normalized();
  const Scalar cosine = b.dot(a);
  Eigen::Quaternion<Scalar> rotation;
  if (cosine < -1 + Eigen::NumTraits<Scalar>::dummy_precision()) {
    const Scalar w_squared = (1 + std::max(cosine, Scalar(-1))) / 2;
    rotation.w() = std::sqrt(w_squared);
    rotation.vec() = a.unitOrthogonal() * std::sqrt(1 - w_squared);
    return rotation;
  }
  const Scalar s = std::sqrt((1 + cosine) * 2);
  rotation.vec() = a.cross(b) * (1 / s);
  rotation.w() = s / 2;
  return rotation;
}

}  // namespace detail

/** The shortest rotation that turns one direction into another; about any perpendicular axis where
 * they are opposite.
 *
 * Step by step as Eigen's Quaternion::FromTwoVectors() but for opposite directions: for these it
 * has a singular value decomposition, which costs each file that calls it 5 s to compile. */
inline Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return detail::shortest_rotation<double>(from, to);
}

inline Eigen::Quaternionf rotation_between(const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  return detail::shortest_rotation<float>(from, to);
}

}  // namespace nao
