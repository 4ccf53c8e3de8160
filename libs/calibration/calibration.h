#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** How one robot's joints and sensors differ from its model, as `nao calibrate` learns it and
 * nao-motion corrects it. The words are those of disturbances/NAME.yaml. */
struct Calibration {
  /** No difference: zeros, and scales of 1. */
  explicit Calibration(const RobotModel& model);

  /** Reads a file that to_yaml() wrote, perhaps edited. Joints and sensors that it does not list
   * have no difference.
   * @throws ConfigError  naming file, line and key of what is wrong. */
  static Calibration load(const RobotModel& model, const std::filesystem::path& file);
  /** The same from a text. @param name  Name of the text, for errors. */
  static Calibration parse(const RobotModel& model, const std::string& text,
                           const std::string& name);
  /** Text of a file, with units. */
  std::string to_yaml(const RobotModel& model) const;

  /** When the calibration was made, as a text; empty if it was not. */
  std::string date;
  /** What the encoders read at the joints' angle 0, rad; (num_motors), motor order. */
  std::vector<double> joint_zero;
  /** Rotation vector of the inertial unit's mounting in the torso, rad, torso frame: a vector that
   * the unit reads as r is R(imu_mount) r in the torso. */
  Eigen::Vector3d imu_mount = Eigen::Vector3d::Zero();
  /** reading = scale * true value + offset, on each axis of the unit; rad/s. */
  Eigen::Vector3d gyroscope_scale = Eigen::Vector3d::Ones();
  Eigen::Vector3d gyroscope_offset = Eigen::Vector3d::Zero();
  /** Reading per force of each foot force sensor, 0 if it is dead; in the order of
   * RobotModel::foot_sensors(). */
  std::vector<double> foot_sensor_scale;
};

}  // namespace nao
