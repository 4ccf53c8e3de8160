#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace nao {

/** Pose and heading of a frame on the ground: its position with z = 0, and its rotation about z. */
Eigen::Isometry3d projected_on_ground(const Eigen::Isometry3d& pose);

/** Alignment of the odometry frame, in which nao-motion estimates, with the world of the simulator.
 *
 * The two frames are aligned once, where the true pose is known; their later difference is the
 * error of the estimate. */
class OdometryAlignment {
 public:
  /** Aligns the frames by two poses of the torso at one time, unless they are aligned already.
   * @param utime  Robot time; if it runs backwards, the robot was restarted and the frames are
   *   aligned again. @param true_torso_in_world  nullptr if it is not known. */
  void update(int64_t utime, const Eigen::Isometry3d& estimated_torso_in_odometry,
              const Eigen::Isometry3d* true_torso_in_world);

  /** Discards the alignment: the next update() aligns again. */
  void reset() { is_aligned_ = false; }

  /** Identity before the first alignment. */
  const Eigen::Isometry3d& pose_odometry_in_world() const { return pose_odometry_in_world_; }

 private:
  Eigen::Isometry3d pose_odometry_in_world_ = Eigen::Isometry3d::Identity();
  bool is_aligned_ = false;
  int64_t aligned_utime_ = 0;
};

}  // namespace nao
