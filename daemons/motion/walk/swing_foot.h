#pragma once

#include "kinematics/pose2.h"

namespace nao::motion {

/** Way of a foot through the air from one footprint to the next, which may move while it is under
 * way.
 *
 * Along the ground each coordinate goes, in every tick, on the cubic that leads from where it is
 * and how fast it moves to rest at the goal; the height is a parabola over time. */
class SwingFoot {
 public:
  /** Takes off at rest. @param start  In the frame of the standing sole. @param height  Where it is
   * now over the ground, m (not 0 where the ground was met early or late). */
  void start(const Pose2& start, double height);

  /** Goes on for a tick.
   * @param goal       In the same frame.
   * @param remaining  s until it shall rest over the goal.
   * @param phase      Share of the way through the air, 0..1. @param lift  Height half-way, m. */
  void step(const Pose2& goal, double remaining, double phase, double lift, double dt);

  const Pose2& pose() const { return pose_; }
  /** How fast it moves ahead, seen from itself, m/s. */
  double forward_speed() const {
    return (Eigen::Rotation2Dd(-pose_.heading) * velocity_.head<2>()).x();
  }
  /** Over the ground, m. */
  double height() const { return height_; }
  /** Lowers a foot that has not met the ground where it should. */
  void lower(double by) { height_ -= by; }

 private:
  Pose2 pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  double start_height_ = 0;
  double height_ = 0;
};

}  // namespace nao::motion
