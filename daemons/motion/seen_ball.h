#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace nao::motion {

/** The ball as nao-vision knows it. */
struct SeenBall {
  /** Robot time at which it was last seen, microseconds. */
  int64_t utime = 0;
  /** On the ground, m, odometry frame. */
  Eigen::Vector2d position_in_odometry = Eigen::Vector2d::Zero();
};

}  // namespace nao::motion
