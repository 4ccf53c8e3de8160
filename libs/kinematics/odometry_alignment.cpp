#include "kinematics/odometry_alignment.h"

#include <cmath>

namespace nao {

Eigen::Isometry3d projected_on_ground(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d forward = pose.linear().col(0);
  Eigen::Isometry3d flat = Eigen::Isometry3d::Identity();
  flat.rotate(Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ()));
  flat.translation() << pose.translation().x(), pose.translation().y(), 0;
  return flat;
}

void OdometryAlignment::update(int64_t utime, const Eigen::Isometry3d& estimated_torso_in_odometry,
                               const Eigen::Isometry3d* true_torso_in_world) {
  if (utime < aligned_utime_) is_aligned_ = false;
  if (is_aligned_ || true_torso_in_world == nullptr) return;
  // Both frames have z upwards and the ground at z = 0: only position and heading differ.
  pose_odometry_in_world_ = projected_on_ground(*true_torso_in_world) *
                            projected_on_ground(estimated_torso_in_odometry).inverse();
  aligned_utime_ = utime;
  is_aligned_ = true;
}

}  // namespace nao
