#pragma once

#include <cmath>
#include <cstdint>

#include "phone-gateway/server/exhibition/fence.h"

namespace nao::gateway {

/** Where the robot is in the fence's frame, by its odometry. That begins anew when nao-motion does:
 * the place goes on from where it was, unless the world began anew, too. */
class RobotPlace {
 public:
  /** @param utime  Robot time, microseconds. @param odometry  Pose of the torso. */
  void update(int64_t utime, const GroundPose& odometry) {
    const bool is_new_world = utime < utime_;
    const bool has_jumped =
        is_known_ && std::hypot(odometry.x - odometry_.x, odometry.y - odometry_.y) > kJump;
    if (is_new_world) {
      frame_ = {};
    } else if (has_jumped) {
      align(odometry, pose());
    }
    utime_ = utime;
    odometry_ = odometry;
    is_known_ = true;
  }

  /** The robot is here: what it sees is believed rather than its odometry. */
  void correct(const GroundPose& pose) {
    if (is_known_) align(odometry_, pose);
  }

  bool is_known() const { return is_known_; }
  GroundPose pose() const {
    const double c = std::cos(frame_.theta);
    const double s = std::sin(frame_.theta);
    return {frame_.x + c * odometry_.x - s * odometry_.y,
            frame_.y + s * odometry_.x + c * odometry_.y, frame_.theta + odometry_.theta};
  }

 private:
  /** m between two states, 0.01 to 0.1 s apart: no robot walks so fast. Chosen. */
  static constexpr double kJump = 0.3;

  /** Chooses the frame so that a pose of the odometry is that pose of the fence's frame. */
  void align(const GroundPose& odometry, const GroundPose& pose) {
    frame_.theta = pose.theta - odometry.theta;
    const double c = std::cos(frame_.theta);
    const double s = std::sin(frame_.theta);
    frame_.x = pose.x - c * odometry.x + s * odometry.y;
    frame_.y = pose.y - s * odometry.x - c * odometry.y;
  }

  /** Pose of the odometry's frame in the fence's. */
  GroundPose frame_;
  GroundPose odometry_;
  int64_t utime_ = 0;
  bool is_known_ = false;
};

}  // namespace nao::gateway
