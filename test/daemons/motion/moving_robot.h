#pragma once

#include <cmath>

#include "daemons/motion/robot_state.h"

namespace nao::motion {

/** A robot whose center of mass is at a height of 1 m over the middle of soles that head to the
 * left, both 0.2 by 0.3 m together, at a velocity, m/s, in their frame. The capture point is ahead
 * of the center of mass by 0.319 s times the velocity. */
inline RobotState moving(double ahead, double left) {
  RobotState state;
  state.torso_in_odometry.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  state.center_of_mass_in_odometry = {0, 0, 1};
  state.center_of_mass_velocity_in_odometry = {-left, ahead, 0};
  state.support_polygon_in_odometry = {{-0.15, -0.1}, {0.15, -0.1}, {0.15, 0.1}, {-0.15, 0.1}};
  state.left_foot_carries = state.right_foot_carries = true;
  return state;
}

}  // namespace nao::motion
