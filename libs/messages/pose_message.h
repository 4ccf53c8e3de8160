#pragma once

#include <Eigen/Geometry>

namespace nao {

/** A pose as messages carry it: position, m, and a quaternion w, x, y, z.
 * @throws MessageError  if a number is not finite or the quaternion's norm is not 1. */
Eigen::Isometry3d decode_pose(const double (&position)[3], const double (&quaternion)[4]);

}  // namespace nao
