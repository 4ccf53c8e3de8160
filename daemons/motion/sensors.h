#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace nao::motion {

/** Measurements of one control step; every number is finite and every list complete. */
struct Sensors {
  /** Robot time, microseconds, and control tick. */
  int64_t utime = 0;
  int64_t tick = 0;
  /** Control period, s. */
  double period = 0.01;
  /** rad (hands: opening), rad/s, N m; each (num_motors), motor order. */
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> torque;
  /** What the servos hold, as last commanded: rad (hands: opening), and fraction of the peak
   * torque, 0 to 1; each (num_motors), motor order. */
  std::vector<double> target_position;
  std::vector<double> stiffness;
  /** Specific force, m/s^2, torso frame: (0, 0, +9.81) upright at rest. */
  Eigen::Vector3d accelerometer_torso = {0, 0, 9.81};
  /** Angular velocity of the torso, rad/s, torso frame. */
  Eigen::Vector3d gyroscope_torso = Eigen::Vector3d::Zero();
  /** Orientation as the inertial unit estimates it; its heading drifts. */
  Eigen::Quaterniond orientation_torso_in_world = Eigen::Quaterniond::Identity();
  /** N, never negative, (foot_sensors().size()), in the order of RobotModel::foot_sensors(). */
  std::vector<double> foot_force;
};

}  // namespace nao::motion
