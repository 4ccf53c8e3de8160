#pragma once

#include <Eigen/Core>
#include <string>

namespace nao::viewer {

/** Link name of the handle of the ball. */
inline constexpr const char* kBallLink = "ball";

/** A sphere that can be grabbed with the mouse: a link of a robot, or the ball. */
struct Handle {
  /** Name of the robot; empty for the ball. */
  std::string robot;
  std::string link;
  /** m, in the world. */
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  /** m. */
  double radius = 0;
};

}  // namespace nao::viewer
