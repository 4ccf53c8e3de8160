#pragma once

#include <cstdint>

#include "kinematics/pose2.h"

namespace nao::gateway {

/** Where the robot is in the fence's frame, by its odometry. That begins anew when nao-motion does:
 * the place goes on from where it was, unless the world began anew, too. */
class RobotPlace {
 public:
  /** @param utime  Robot time, microseconds. @param odometry  Pose of the torso. */
  void update(int64_t utime, const Pose2& odometry) {
    const bool is_new_world = utime < utime_;
    const bool has_jumped = is_known_ && (odometry.position - odometry_.position).norm() > kJump;
    if (is_new_world) {
      frame_ = {};
    } else if (has_jumped) {
      frame_ = pose() * odometry.inverse();
    }
    utime_ = utime;
    odometry_ = odometry;
    is_known_ = true;
  }

  /** The robot is here: what it sees is believed rather than its odometry. */
  void correct(const Pose2& pose) {
    if (is_known_) frame_ = pose * odometry_.inverse();
  }

  bool is_known() const { return is_known_; }
  Pose2 pose() const { return frame_ * odometry_; }

 private:
  /** m between two states, 0.01 to 0.1 s apart: no robot walks so fast. Chosen. */
  static constexpr double kJump = 0.3;

  /** Pose of the odometry's frame in the fence's. */
  Pose2 frame_;
  Pose2 odometry_;
  int64_t utime_ = 0;
  bool is_known_ = false;
};

}  // namespace nao::gateway
