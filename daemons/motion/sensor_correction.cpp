#include "daemons/motion/sensor_correction.h"

#include <Eigen/Geometry>

namespace nao::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Rotation vector (axis times angle, rad) to matrix: the exponential map.
Matrix3d rotation_of(const Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace

SensorCorrection::SensorCorrection(const RobotModel& model, const Calibration& calibration)
    : calibration_(calibration),
      pressure_(model),
      torso_from_unit_(rotation_of(calibration.imu_mount)) {
  for (const double scale : calibration_.foot_sensor_scale) is_dead_.push_back(scale == 0);
}

// Inverse of the error model of the calibration: zero offsets, mounting, scale and offset.
void SensorCorrection::correct(Sensors& sensors) const {
  for (size_t i = 0; i < sensors.position.size(); ++i) {
    sensors.position[i] -= calibration_.joint_zero[i];
    sensors.target_position[i] -= calibration_.joint_zero[i];
  }
  sensors.accelerometer_torso = torso_from_unit_ * sensors.accelerometer_torso;
  sensors.gyroscope_torso =
      torso_from_unit_ * (sensors.gyroscope_torso - calibration_.gyroscope_offset)
                             .cwiseQuotient(calibration_.gyroscope_scale);
  sensors.orientation_torso_in_world =
      sensors.orientation_torso_in_world * Eigen::Quaterniond(torso_from_unit_.transpose());
  for (size_t i = 0; i < sensors.foot_force.size(); ++i) {
    const double scale = calibration_.foot_sensor_scale[i];
    sensors.foot_force[i] = scale > 0 ? sensors.foot_force[i] / scale : 0;
  }
  pressure_.replace_dead(is_dead_, sensors.foot_force);
}

}  // namespace nao::motion
