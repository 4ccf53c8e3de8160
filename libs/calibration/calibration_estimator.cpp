#include "calibration/calibration_estimator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "common/linear_solver.h"

namespace nao {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// The equations are nearly linear in errors of a degree: the third iteration changes nothing.
constexpr int kNumIterations = 3;
// Step of the numeric derivatives, rad, m or 1. Chosen: errors of second order are 1e-9.
constexpr double kStep = 1e-5;
// A sensor is dead if it never reads more than this, N, while in some sample every other sensor of
// its foot does. Chosen: ten steps of the sensor, and a tenth of a foot's load on one sensor.
constexpr double kNoForce = 0.5;
constexpr double kLoaded = 1.0;

}  // namespace

CalibrationEstimator::CalibrationEstimator(const RobotModel& model, const CalibrationPrior& prior)
    : model_(&model),
      prior_(prior),
      kinematics_(model),
      is_left_sensor_(model.foot_sensors().size(), false) {
  // Motors of both legs, each once: HipYawPitch moves both.
  for (const LegDescription& leg : model.legs()) {
    for (const int joint : leg.joints) {
      const int motor = model.motor_of(joint);
      if (motor >= 0 && std::find(motors_.begin(), motors_.end(), motor) == motors_.end()) {
        motors_.push_back(motor);
      }
    }
  }
  for (const int sensor : model.legs()[0].sensors) is_left_sensor_[sensor] = true;
}

// Order of the parameters: joint zeros, mounting (roll, pitch), foot sensors, center of mass (x,
// y), slope (x, y), and four tilts of the soles for each station (a place where the robot stands).
int CalibrationEstimator::num_parameters() const {
  int num_stations = 0;
  for (const StandingSample& sample : samples_) {
    num_stations = std::max(num_stations, sample.station + 1);
  }
  return station_index(num_stations);
}

// Standard deviations of the prior, in the order of the parameters.
VectorXd CalibrationEstimator::calc_deviations() const {
  VectorXd deviations(num_parameters());
  deviations.setConstant(prior_.foot_tilt);
  deviations.head(mount_index()).setConstant(prior_.joint_zero);
  deviations.segment(mount_index(), 2).setConstant(prior_.imu_mount);
  deviations.segment(sensor_index(), com_index() - sensor_index()).setConstant(prior_.foot_sensor);
  deviations.segment(com_index(), 2).setConstant(prior_.center_of_mass);
  deviations.segment(slope_index(), 2).setConstant(prior_.slope);
  return deviations;
}

void CalibrationEstimator::find_dead_sensors() {
  dead_sensors_.clear();
  for (size_t i = 0; i < is_left_sensor_.size(); ++i) {
    bool reads_nothing = true;
    bool are_others_loaded = false;
    for (const StandingSample& sample : samples_) {
      reads_nothing = reads_nothing && sample.foot_force[i] < kNoForce;
      bool are_loaded = true;
      for (size_t k = 0; k < is_left_sensor_.size(); ++k) {
        if (k == i || is_left_sensor_[k] != is_left_sensor_[i]) continue;
        are_loaded = are_loaded && sample.foot_force[k] > kLoaded;
      }
      are_others_loaded = are_others_loaded || are_loaded;
    }
    if (reads_nothing && are_others_loaded) dead_sensors_.push_back(static_cast<int>(i));
  }
}

// Weighted residuals of one sample: rows 0..3 tilt of both soles, rad; 4 and 5 CoP against CoM, m;
// 6 weight. Each is divided by its standard deviation.
CalibrationEstimator::Rows CalibrationEstimator::calc_residuals(const StandingSample& sample,
                                                                const VectorXd& parameters) {
  position_ = sample.position;
  for (size_t i = 0; i < motors_.size(); ++i) {
    position_[motors_[i]] -= parameters[static_cast<long>(i)];
  }
  // Kinematics of the angles without the assumed zero errors.
  kinematics_.update(position_);
  const Vector3d measured = sample.accelerometer.normalized();
  const Vector3d mount(parameters[mount_index()], parameters[mount_index() + 1], 0);
  // The vertical in the torso frame: measured by a unit that is mounted with a small rotation,
  // whose effect is mount x measured.
  const Vector3d up = (measured + mount.cross(measured)).normalized();

  Rows rows = Rows::Zero();
  // The slope is fixed in the room; the robot sees it turned by its own heading.
  const Vector2d slope = Eigen::Rotation2Dd(-sample.heading) * parameters.segment<2>(slope_index());
  const int station = station_index(sample.station);
  // A sole is level up to slope and its own tilt: x and y of the vertical in its frame vanish.
  const Vector3d up_in_left = kinematics_.left_sole().linear().transpose() * up;
  const Vector3d up_in_right = kinematics_.right_sole().linear().transpose() * up;
  rows.segment<2>(0) =
      (up_in_left.head<2>() - slope - parameters.segment<2>(station)) / prior_.sole_noise;
  rows.segment<2>(2) =
      (up_in_right.head<2>() - slope - parameters.segment<2>(station + 2)) / prior_.sole_noise;
  // With two dead sensors the CoP is unknown.
  if (dead_sensors_.size() > 1) return rows;

  const double weight = model_->total_mass() * kGravity;
  double sum = 0;
  Vector3d moment = Vector3d::Zero();
  for (size_t i = 0; i < sample.foot_force.size(); ++i) {
    const double force =
        (1 + parameters[sensor_index() + static_cast<long>(i)]) * sample.foot_force[i];
    sum += force;
    moment += force * kinematics_.link_pose(model_->foot_sensors()[i]).translation();
  }
  // One dead sensor carries what the others leave of the weight; row 6 says nothing then.
  if (dead_sensors_.size() == 1) {
    const double force = std::max(0.0, weight - sum);
    sum += force;
    moment += force * kinematics_.link_pose(model_->foot_sensors()[dead_sensors_[0]]).translation();
  }
  // The robot is held or lifted.
  if (sum < weight / 2) return rows;
  const Vector3d com = kinematics_.center_of_mass() +
                       Vector3d(parameters[com_index()], parameters[com_index() + 1], 0);
  // At rest the CoP is below the CoM: their difference has no horizontal part. The horizontal axes
  // are those of `up`.
  const Vector3d difference = moment / sum - com;
  const Vector3d ahead = (Vector3d::UnitX() - up.x() * up).normalized();
  rows[4] = difference.dot(ahead) / prior_.pressure_noise;
  rows[5] = difference.dot(up.cross(ahead)) / prior_.pressure_noise;
  if (dead_sensors_.empty()) rows[6] = (sum / weight - 1) / prior_.weight_noise;
  return rows;
}

double CalibrationEstimator::calc_pressure_error(const VectorXd& parameters) {
  double sum = 0;
  for (const StandingSample& sample : samples_) {
    sum += calc_residuals(sample, parameters).segment<2>(4).squaredNorm();
  }
  return prior_.pressure_noise * std::sqrt(sum / static_cast<double>(samples_.size()));
}

Calibration CalibrationEstimator::solve() {
  Calibration result(*model_);
  if (samples_.empty()) return result;
  find_dead_sensors();
  const VectorXd deviations = calc_deviations();
  VectorXd parameters = VectorXd::Zero(deviations.size());
  pressure_error_before_ = calc_pressure_error(parameters);
  // Maximum a posteriori estimate: Gauss-Newton with the prior as one more row for each parameter.
  // The prior decides what the samples do not determine.
  const VectorXd information = deviations.cwiseAbs2().cwiseInverse();
  for (int iteration = 0; iteration < kNumIterations; ++iteration) {
    MatrixXd normal = information.asDiagonal();
    VectorXd gradient = information.cwiseProduct(parameters);
    for (const StandingSample& sample : samples_) {
      const Rows rows = calc_residuals(sample, parameters);
      MatrixXd jacobian(kNumRows, parameters.size());
      VectorXd moved = parameters;
      // One-sided numeric derivative: kinematics and all errors in one.
      for (int k = 0; k < parameters.size(); ++k) {
        moved[k] += kStep;
        jacobian.col(k) = (calc_residuals(sample, moved) - rows) / kStep;
        moved[k] = parameters[k];
      }
      normal += jacobian.transpose().lazyProduct(jacobian);
      gradient += jacobian.transpose() * rows;
    }
    // (J^T J + prior) step = J^T r + prior * parameters.
    solve_positive_definite(normal, gradient);
    parameters -= gradient;
  }
  pressure_error_after_ = calc_pressure_error(parameters);
  return to_calibration(parameters);
}

Calibration CalibrationEstimator::to_calibration(const VectorXd& parameters) const {
  // Factors nearer to 0 than this come from a sensor that reads far too much: a broken one.
  constexpr double kMinFactor = 0.25;
  Calibration result(*model_);
  for (size_t i = 0; i < motors_.size(); ++i) {
    result.joint_zero[motors_[i]] = parameters[static_cast<long>(i)];
  }
  result.imu_mount.head<2>() = parameters.segment<2>(mount_index());
  for (size_t i = 0; i < result.foot_sensor_scale.size(); ++i) {
    // The parameter is the correction of the reading; the file states the sensor's own scale, its
    // inverse.
    const double factor = 1 + parameters[sensor_index() + static_cast<long>(i)];
    result.foot_sensor_scale[i] = 1 / std::max(kMinFactor, factor);
  }
  for (const int sensor : dead_sensors_) result.foot_sensor_scale[sensor] = 0;
  // A standing robot does not rotate: the mean reading is the offset.
  for (const StandingSample& sample : samples_) result.gyroscope_offset += sample.gyroscope;
  result.gyroscope_offset /= static_cast<double>(samples_.size());
  return result;
}

}  // namespace nao
