#include "sim/sensors.h"

#include <algorithm>
#include <cmath>

namespace nao::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Deviation of the specific force from gravity, m/s^2, at which it has no influence on the tilt
 * estimate, since the robot accelerates. Assumed. */
constexpr double kMaxTiltDeviation = 2;

/** Quaternion of a rotation vector. */
Quaterniond rotation_of(const Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

Vector3d clipped(const Vector3d& v, double range) {
  return v.cwiseMax(-range).cwiseMin(range);
}

}  // namespace

Sensors::Sensors(const RobotModel& model, const SensorOptions& options, uint64_t seed)
    : options_(options),
      // A unit that is mounted with a rotation R to the torso reads R^T times the torso's vector.
      unit_from_torso_(rotation_of(options.errors.imu_mount).conjugate().toRotationMatrix()),
      random_(seed) {
  const int num_motors = model.num_motors();
  readings_.position = Eigen::VectorXd::Zero(num_motors);
  readings_.velocity = readings_.position;
  readings_.torque = readings_.position;
  readings_.foot_force = Eigen::VectorXd::Zero(static_cast<long>(model.foot_sensors().size()));

  // Sensor and sole belong to the same foot: their relative pose is that of any posture.
  const std::vector<double> zero(num_motors, 0.0);
  const std::vector<Eigen::Isometry3d> poses = model.link_poses(zero);
  for (const LegDescription& foot : model.legs()) {
    std::vector<Vector2d> positions;
    for (const int sensor : foot.sensors) {
      const Vector3d position =
          poses[foot.sole].inverse() * poses[model.foot_sensors()[sensor]].translation();
      positions.push_back(position.head<2>());
    }
    feet_.push_back({foot.sensors, FootLoad(std::move(positions))});
  }
}

void Sensors::reset(const TrueMotion& truth) {
  // Constant offsets of this run, drawn once; the noise comes with every reading.
  const auto draw = [this](double deviation) {
    Vector3d bias;
    for (double& x : bias) x = deviation * random_.normal();
    return bias;
  };
  accelerometer_bias_.setZero();
  gyroscope_bias_.setZero();
  if (!options_.is_ideal) {
    accelerometer_bias_ = draw(options_.accelerometer_bias);
    gyroscope_bias_ = draw(options_.gyroscope_bias);
  }
  readings_.tick = 0;
  readings_.time = 0;
  jump(truth);
}

void Sensors::jump(const TrueMotion& truth) {
  readings_.orientation = truth.orientation;
  if (!options_.is_ideal && !options_.errors.imu_mount.isZero(0)) {
    readings_.orientation = truth.orientation * rotation_of(options_.errors.imu_mount);
  }
  for (int i = 0; i < readings_.position.size(); ++i) {
    readings_.position[i] = quantized(truth.position[i]);
  }
  // Velocity 0: position has not changed since the line above.
  // With no change of position the speed is 0 over any period; the estimate needs a period of 0.
  measure_joints(truth, 1);
  measure_inertia(truth, 0);
  measure_feet(truth);
}

void Sensors::set_tick(int64_t tick, double period) {
  readings_.tick = tick;
  readings_.time = static_cast<double>(tick) * period;
}

void Sensors::update(const TrueMotion& truth, double period) {
  ++readings_.tick;
  readings_.time = static_cast<double>(readings_.tick) * period;
  measure_joints(truth, period);
  measure_inertia(truth, period);
  measure_feet(truth);
}

// An encoder's position is a multiple of its resolution, rad.
double Sensors::quantized(double position) const {
  if (options_.is_ideal) return position;
  const double step = 2 * M_PI / options_.encoder_steps;
  return std::round(position / step) * step;
}

void Sensors::measure_joints(const TrueMotion& truth, double period) {
  for (int i = 0; i < readings_.position.size(); ++i) {
    const double position = quantized(truth.position[i]);
    // Velocity is the difference quotient of quantized positions, as a joint board computes it: at
    // low speed it is 0 or one quantum per tick.
    readings_.velocity[i] = (position - readings_.position[i]) / period;
    readings_.position[i] = position;
  }
  readings_.torque = truth.torque;
}

void Sensors::add_inertial_errors() {
  const RobotErrors& errors = options_.errors;
  // Order of a real unit: mounting, scale and offset of its axes, noise, and the range last.
  if (!errors.imu_mount.isZero(0)) {
    readings_.accelerometer = unit_from_torso_ * readings_.accelerometer;
    readings_.gyroscope = unit_from_torso_ * readings_.gyroscope;
  }
  readings_.accelerometer = readings_.accelerometer.cwiseProduct(errors.accelerometer_scale);
  readings_.gyroscope =
      readings_.gyroscope.cwiseProduct(errors.gyroscope_scale) + errors.gyroscope_offset;
  for (int k = 0; k < 3; ++k) {
    readings_.accelerometer[k] +=
        accelerometer_bias_[k] + options_.accelerometer_noise * random_.normal();
    readings_.gyroscope[k] += gyroscope_bias_[k] + options_.gyroscope_noise * random_.normal();
  }
  readings_.accelerometer = clipped(readings_.accelerometer, options_.accelerometer_range);
  readings_.gyroscope = clipped(readings_.gyroscope, options_.gyroscope_range);
}

void Sensors::measure_inertia(const TrueMotion& truth, double period) {
  // Repeated in ticks in which the value is not read anew, see imu_alternates.
  const Vector3d last_accelerometer = readings_.accelerometer;
  const Vector3d last_gyroscope = readings_.gyroscope;
  readings_.accelerometer = truth.specific_force;
  readings_.gyroscope = truth.angular_velocity;
  if (options_.is_ideal) {
    readings_.orientation = truth.orientation;
    return;
  }
  add_inertial_errors();
  // At rest before the first tick both are read.
  const bool alternates = options_.errors.imu_alternates && period > 0;
  readings_.is_accelerometer_new = !alternates || readings_.tick % 2 == 0;
  readings_.is_gyroscope_new = !alternates || readings_.tick % 2 == 1;
  if (!readings_.is_accelerometer_new) readings_.accelerometer = last_accelerometer;
  if (!readings_.is_gyroscope_new) readings_.gyroscope = last_gyroscope;

  // Mahony's filter: the gyroscope is integrated, and a rotation from the estimated to the measured
  // vertical is added at tilt_gain, the less the more the specific force differs from gravity.
  Quaterniond& estimate = readings_.orientation;
  const double force = readings_.accelerometer.norm();
  const double weight = std::clamp(1 - std::abs(force - kGravity) / kMaxTiltDeviation, 0.0, 1.0);
  Vector3d correction = Vector3d::Zero();
  if (weight > 0) {
    // Vertical in the unit's axes by the estimate. The cross product of measured and estimated
    // vertical is the rotation vector between them for small angles. Heading is not observable this
    // way, and drifts.
    const Vector3d up = estimate.conjugate() * Vector3d::UnitZ();
    correction = options_.tilt_gain * weight * (readings_.accelerometer / force).cross(up);
  }
  // The correction and the gyroscope's rate are in the body's axes: multiplied from the right.
  // A unit knows its gyroscope's constant offset from when it was switched on, at rest.
  const Vector3d rate = readings_.gyroscope - options_.errors.gyroscope_offset;
  estimate = (estimate * rotation_of((rate + correction) * period)).normalized();
}

void Sensors::measure_feet(const TrueMotion& truth) {
  for (size_t side = 0; side < feet_.size(); ++side) {
    FootSensors& foot = feet_[side];
    const TrueMotion::FootLoad& load = truth.feet[side];
    const bool is_loaded = load.force > 0;
    const std::vector<double>* fractions = nullptr;
    // Moment over force: the center of pressure in the sole's frame.
    if (is_loaded) fractions = &foot.load.distribute(load.moment / load.force);
    for (size_t i = 0; i < foot.sensors.size(); ++i) {
      double force = (is_loaded ? (*fractions)[i] : 0.0) * load.force;
      if (!options_.is_ideal) {
        const Eigen::VectorXd& scale = options_.errors.foot_sensor_scale;
        // Order of a real sensor: sensitivity, noise proportional to the force, resolution, range.
        if (scale.size() > 0) force *= scale[foot.sensors[i]];
        force *= 1 + options_.foot_force_noise * random_.normal();
        force = std::round(force / options_.foot_force_step) * options_.foot_force_step;
        force = std::clamp(force, 0.0, options_.foot_force_range);
      }
      readings_.foot_force[foot.sensors[i]] = force;
    }
  }
}

}  // namespace nao::sim
