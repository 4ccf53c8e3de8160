#pragma once

#include <Eigen/Core>

namespace nao::sim {

/** How one robot differs from its model: in joints, sensors, and the delivery of messages. By
 * default it does not differ. */
struct RobotErrors {
  /** Total play between motor and link, rad, and what the encoder reads at the joint's angle 0,
   * rad; in motor order, (num_motors) or empty. */
  Eigen::VectorXd backlash;
  Eigen::VectorXd joint_zero;
  /** Factors on the servos' proportional and derivative gains, (num_motors) or empty. */
  Eigen::VectorXd servo_stiffness;
  Eigen::VectorXd servo_damping;
  /** Rotation vector of the inertial unit's mounting in the torso, rad, torso frame. */
  Eigen::Vector3d imu_mount = Eigen::Vector3d::Zero();
  /** Factors on the readings of each axis, and the gyroscope's additional offset, rad/s. */
  Eigen::Vector3d gyroscope_scale = Eigen::Vector3d::Ones();
  Eigen::Vector3d gyroscope_offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d accelerometer_scale = Eigen::Vector3d::Ones();
  /** Whether accelerometer and gyroscope are read in turns, each in every other control tick. */
  bool imu_alternates = false;
  /** Factor on the reading of each force sensor of the feet, 0 if it is dead; in the order of
   * RobotModel::foot_sensors(), or empty. */
  Eigen::VectorXd foot_sensor_scale;
  /** Offset of the root link's center of mass, m, in its frame. */
  Eigen::Vector3d torso_com = Eigen::Vector3d::Zero();
  /** Probability in each control tick that the sensor readings, or the joint command that is given
   * in it, do not arrive. */
  double sensor_loss = 0;
  double command_loss = 0;
};

}  // namespace nao::sim
