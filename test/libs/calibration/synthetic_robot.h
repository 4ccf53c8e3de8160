#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "calibration/calibration.h"
#include "calibration/standing_sample.h"
#include "common/constants.h"
#include "common/random.h"
#include "kinematics/kinematics.h"

namespace nao {

/** Sensor readings of a standing robot with known errors: statics, without physics. Both soles lie
 * on one floor with a slope; the forces have the center of mass's ground projection as their center
 * and differ by as little as possible otherwise. */
class SyntheticRobot {
 public:
  SyntheticRobot(const RobotModel& model, const Calibration& truth)
      : model_(&model), truth_(truth), kinematics_(model) {}

  /** Slope of the floor in the direction of heading 0: rotation vector, rad. */
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();

  /** @param position  True angles, with soles parallel. */
  StandingSample stand(const std::vector<double>& position, int station, double heading) {
    kinematics_.update(position);
    StandingSample sample;
    sample.station = station;
    sample.heading = heading;
    sample.position = position;
    for (size_t i = 0; i < position.size(); ++i) sample.position[i] += truth_.joint_zero[i];
    const Eigen::Vector3d in_floor = Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) * slope;
    const Eigen::Vector3d up = kinematics_.left_sole().linear() * rotation(in_floor).transpose() *
                               Eigen::Vector3d::UnitZ();
    sample.accelerometer = kGravity * (rotation(truth_.imu_mount).transpose() * up);
    sample.gyroscope = truth_.gyroscope_offset;
    add_forces(up, sample);
    return sample;
  }

 private:
  static Eigen::Matrix3d rotation(const Eigen::Vector3d& vector) {
    const double angle = vector.norm();
    if (angle == 0) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
  }

  /** Least squares of the forces with their sum and center given. */
  void add_forces(const Eigen::Vector3d& up, StandingSample& sample) {
    const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
    const Eigen::Vector3d left = up.cross(ahead);
    const auto count = static_cast<long>(model_->foot_sensors().size());
    const double weight = model_->total_mass() * kGravity;
    Eigen::MatrixXd terms(3, count);
    for (long i = 0; i < count; ++i) {
      const Eigen::Vector3d arm = kinematics_.link_pose(model_->foot_sensors()[i]).translation() -
                                  kinematics_.center_of_mass();
      terms.col(i) << 1, arm.dot(ahead), arm.dot(left);
    }
    const Eigen::Matrix3d normal = terms * terms.transpose();
    const Eigen::VectorXd force =
        terms.transpose() * (normal.inverse() * Eigen::Vector3d(weight, 0, 0));
    for (long i = 0; i < count; ++i) {
      sample.foot_force.push_back(std::max(0.0, force[i]) * truth_.foot_sensor_scale[i]);
    }
  }

  const RobotModel* model_;
  Calibration truth_;
  Kinematics kinematics_;
};

}  // namespace nao
