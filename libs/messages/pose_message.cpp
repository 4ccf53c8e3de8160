#include "messages/pose_message.h"

#include <cmath>
#include <string>

#include "common/error.h"

namespace nao {
namespace {

/** Allowed deviation of a quaternion's norm from 1. Chosen: far above rounding errors, small enough
 * that a damaged message is rejected. */
constexpr double kNormTolerance = 1e-3;

}  // namespace

Eigen::Isometry3d decode_pose(const double (&position)[3], const double (&quaternion)[4]) {
  const Eigen::Quaterniond rotation(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  const Eigen::Vector3d translation(position[0], position[1], position[2]);
  if (!translation.allFinite()) throw MessageError("a position is not finite");
  // Written so that NaN fails.
  if (!(std::abs(rotation.norm() - 1) < kNormTolerance)) {
    throw MessageError("a quaternion has the norm " + std::to_string(rotation.norm()) +
                       " instead of 1");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = translation;
  return pose;
}

}  // namespace nao
