#pragma once

#include "kinematics/pose2.h"

namespace nao::motion {

/** Trajectory of the swing foot to a foothold that may change during the step.
 *
 * Along the ground each coordinate follows, replanned in every tick, the cubic from its present
 * position and velocity to rest at the foothold. The height is a polynomial of the swing phase. */
class SwingFoot {
 public:
  /** Lifts off at rest. @param start  Pose in the support frame. @param height  Height of the sole
   * over the ground now, m; not 0 where the ground was met early or late. */
  void start(const Pose2& start, double height);

  /** One tick.
   * @param foothold   In the support frame.
   * @param remaining  Time until the foot is at rest over the foothold, s.
   * @param phase      Elapsed fraction of the swing, 0..1. @param lift  Height at mid-swing, m. */
  void step(const Pose2& foothold, double remaining, double phase, double lift, double dt);

  const Pose2& pose() const { return pose_; }
  /** Velocity along the foot's own x axis, m/s. */
  double forward_velocity() const {
    return (Eigen::Rotation2Dd(-pose_.heading) * velocity_.head<2>()).x();
  }
  /** Height over the ground, m. */
  double height() const { return height_; }
  /** Lowers the foot, m. */
  void lower(double distance) { height_ -= distance; }

 private:
  Pose2 pose_;
  /** x, y, heading: m/s, rad/s. */
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  double start_height_ = 0;
  double height_ = 0;
};

}  // namespace nao::motion
