#include "daemons/motion/sensor_correction.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace nao::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rotation_of(const Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace

SensorCorrection::SensorCorrection(const RobotModel& model, const Calibration& calibration)
    : calibration_(calibration), torso_from_unit_(rotation_of(calibration.imu_mount)) {
  find_dead_sensors(model);
}

void SensorCorrection::find_dead_sensors(const RobotModel& model) {
  const std::vector<double>& scale = calibration_.foot_sensor_scale;
  const auto poses = model.link_poses(std::vector<double>(model.num_motors(), 0.0));
  for (const LegDescription& leg : model.legs()) {
    // Of a sensor: 1 and its position in the sole, the terms of a linear pressure.
    const auto terms = [&](int sensor) {
      const Vector3d position =
          poses[leg.sole].inverse() * poses[model.foot_sensors()[sensor]].translation();
      return Vector3d(1, position.x(), position.y());
    };
    Matrix3d normal = Matrix3d::Zero();
    int num_alive = 0;
    for (const int sensor : leg.sensors) {
      if (scale[sensor] == 0) continue;
      normal += terms(sensor) * terms(sensor).transpose();
      ++num_alive;
    }
    // Three sensors determine the pressure; with fewer the dead ones stay at 0.
    if (num_alive < 3 || normal.determinant() == 0) continue;
    const Matrix3d inverse = normal.inverse();
    for (const int dead : leg.sensors) {
      if (scale[dead] != 0) continue;
      std::vector<double> weights(scale.size(), 0.0);
      for (const int sensor : leg.sensors) {
        if (scale[sensor] != 0) weights[sensor] = terms(dead).dot(inverse * terms(sensor));
      }
      dead_sensors_.push_back({static_cast<size_t>(dead), std::move(weights)});
    }
  }
}

void SensorCorrection::correct(Sensors& sensors) const {
  for (size_t i = 0; i < sensors.position.size(); ++i) {
    sensors.position[i] -= calibration_.joint_zero[i];
    sensors.target_position[i] -= calibration_.joint_zero[i];
  }
  sensors.accelerometer_torso = torso_from_unit_ * sensors.accelerometer_torso;
  sensors.gyroscope_torso =
      torso_from_unit_ * (sensors.gyroscope_torso - calibration_.gyroscope_offset)
                             .cwiseQuotient(calibration_.gyroscope_scale);
  for (size_t i = 0; i < sensors.foot_force.size(); ++i) {
    const double scale = calibration_.foot_sensor_scale[i];
    sensors.foot_force[i] = scale > 0 ? sensors.foot_force[i] / scale : 0;
  }
  for (const DeadSensor& dead : dead_sensors_) {
    double force = 0;
    for (size_t i = 0; i < dead.weights.size(); ++i) {
      force += dead.weights[i] * sensors.foot_force[i];
    }
    sensors.foot_force[dead.sensor] = std::max(0.0, force);
  }
}

}  // namespace nao::motion
