#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

namespace nao::motion {

/** Estimate of the robot's state from its sensors alone; see robot_state_t. O is the odometry
 * frame: on the ground, z up, with its origin below the torso when the estimator started. */
struct RobotState {
  /** Robot time, microseconds, and control tick of the sensor data. */
  int64_t utime = 0;
  int64_t tick = 0;
  /** rad, rad/s; (num_motors), motor order. */
  std::vector<double> joint_position;
  std::vector<double> joint_velocity;

  /** Torso frame in O. The translation's z is the torso's height over the ground, m. */
  Eigen::Isometry3d torso_in_odometry = Eigen::Isometry3d::Identity();
  /** m/s, in the torso's heading frame (x forward, z up). */
  Eigen::Vector3d velocity_torso_in_heading = Eigen::Vector3d::Zero();
  /** rad/s, torso frame. */
  Eigen::Vector3d angular_velocity_torso = Eigen::Vector3d::Zero();

  /** Whole-body center of mass in O, m, and its velocity, m/s. */
  Eigen::Vector3d center_of_mass_in_odometry = Eigen::Vector3d::Zero();
  Eigen::Vector3d center_of_mass_velocity_in_odometry = Eigen::Vector3d::Zero();
  /** In O, m; NaN while no foot carries weight. */
  Eigen::Vector2d center_of_pressure_in_odometry =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  /** Sum of each foot's force sensors, N; or estimated from the joint torques. */
  double left_foot_force = 0;
  double right_foot_force = 0;
  /** Which feet carry weight. */
  bool left_foot_carries = false;
  bool right_foot_carries = false;
  /** Soles in O. */
  Eigen::Isometry3d left_sole_in_odometry = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d right_sole_in_odometry = Eigen::Isometry3d::Identity();

  /** Angle between the directions of up by the robot's own roll and pitch and by accelerometer and
   * gyroscope, rad, if it has been too great for too long (OrientationCheck); else 0. */
  double orientation_doubt = 0;

  /** Convex, counter-clockwise from above, m, in O; empty while no foot carries weight. */
  std::vector<Eigen::Vector2d> support_polygon_in_odometry;
  /** Distance of the center of mass's ground projection to the polygon's edge, m; negative outside,
   * NaN while no foot carries weight. */
  double balance_margin = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace nao::motion
