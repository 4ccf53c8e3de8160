#include "sim/sensors.h"

#include <algorithm>
#include <cmath>

namespace nao::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

Quaterniond rotation_of(const Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

Vector3d limited(const Vector3d& v, double range) {
  return v.cwiseMax(-range).cwiseMin(range);
}

}  // namespace

std::array<double, 4> corner_shares(const std::array<Vector2d, 4>& corners, const Vector2d& point) {
  // Bilinear shares: s from rear to front, t from right to left. Newton's method on the two
  // equations; sensors lie nearly on a rectangle, where the first step is exact.
  const Vector2d& front_left = corners[0];
  const Vector2d& front_right = corners[1];
  const Vector2d& rear_left = corners[2];
  const Vector2d& rear_right = corners[3];
  double s = 0.5;
  double t = 0.5;
  for (int iteration = 0; iteration < 6; ++iteration) {
    const Vector2d front = t * front_left + (1 - t) * front_right;
    const Vector2d rear = t * rear_left + (1 - t) * rear_right;
    const Vector2d error = point - (s * front + (1 - s) * rear);
    const Vector2d along_s = front - rear;
    const Vector2d along_t = s * (front_left - front_right) + (1 - s) * (rear_left - rear_right);
    const double determinant = along_s.x() * along_t.y() - along_s.y() * along_t.x();
    if (std::abs(determinant) < 1e-12) break;
    s += (error.x() * along_t.y() - error.y() * along_t.x()) / determinant;
    t += (along_s.x() * error.y() - along_s.y() * error.x()) / determinant;
  }
  s = std::clamp(s, 0.0, 1.0);
  t = std::clamp(t, 0.0, 1.0);
  return {s * t, s * (1 - t), (1 - s) * t, (1 - s) * (1 - t)};
}

Sensors::Sensors(const RobotModel& model, const SensorOptions& options, uint64_t seed)
    : options_(options), random_(seed) {
  const int num_motors = model.num_motors();
  readings_.position = Eigen::VectorXd::Zero(num_motors);
  readings_.velocity = readings_.position;
  readings_.torque = readings_.position;
  readings_.foot_force = Eigen::VectorXd::Zero(static_cast<long>(model.foot_sensors().size()));

  const std::vector<double> zero(num_motors, 0.0);
  const std::vector<Eigen::Isometry3d> poses = model.link_poses(zero);
  const int soles[] = {model.left_sole(), model.right_sole()};
  for (size_t i = 0; i < model.foot_sensors().size(); ++i) {
    // Left foot first.
    const int side = i < model.foot_sensors().size() / 2 ? 0 : 1;
    const Vector3d place =
        poses[soles[side]].inverse() * poses[model.foot_sensors()[i]].translation();
    feet_[side].push_back({place.head<2>(), static_cast<int>(i)});
  }
}

void Sensors::reset(const TrueMotion& truth) {
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
  for (int i = 0; i < readings_.position.size(); ++i) {
    readings_.position[i] = quantized(truth.position[i]);
  }
  measure_joints(truth, 1);
  measure_inertia(truth, 0);
  measure_feet(truth);
}

void Sensors::update(const TrueMotion& truth, double period) {
  ++readings_.tick;
  readings_.time = static_cast<double>(readings_.tick) * period;
  measure_joints(truth, period);
  measure_inertia(truth, period);
  measure_feet(truth);
}

double Sensors::quantized(double position) const {
  if (options_.is_ideal) return position;
  const double step = 2 * M_PI / options_.encoder_steps;
  return std::round(position / step) * step;
}

void Sensors::measure_joints(const TrueMotion& truth, double period) {
  for (int i = 0; i < readings_.position.size(); ++i) {
    const double position = quantized(truth.position[i]);
    readings_.velocity[i] = (position - readings_.position[i]) / period;
    readings_.position[i] = position;
  }
  readings_.torque = truth.torque;
}

void Sensors::measure_inertia(const TrueMotion& truth, double period) {
  readings_.accelerometer = truth.specific_force;
  readings_.gyroscope = truth.angular_velocity;
  if (options_.is_ideal) {
    readings_.orientation = truth.orientation;
    return;
  }
  for (int k = 0; k < 3; ++k) {
    readings_.accelerometer[k] +=
        accelerometer_bias_[k] + options_.accelerometer_noise * random_.normal();
    readings_.gyroscope[k] += gyroscope_bias_[k] + options_.gyroscope_noise * random_.normal();
  }
  readings_.accelerometer = limited(readings_.accelerometer, options_.accelerometer_range);
  readings_.gyroscope = limited(readings_.gyroscope, options_.gyroscope_range);

  // The unit integrates the gyroscope and lets roll and pitch follow the accelerometer slowly, as
  // far as that shows gravity alone (R. Mahony et al., IEEE TAC 53(5), 2008).
  Quaterniond& estimate = readings_.orientation;
  const double force = readings_.accelerometer.norm();
  const double trust = std::clamp(1 - std::abs(force - 9.81) / 2, 0.0, 1.0);
  Vector3d correction = Vector3d::Zero();
  if (trust > 0) {
    const Vector3d up = estimate.conjugate() * Vector3d::UnitZ();
    correction = options_.tilt_gain * trust * (readings_.accelerometer / force).cross(up);
  }
  estimate = (estimate * rotation_of((readings_.gyroscope + correction) * period)).normalized();
}

void Sensors::measure_feet(const TrueMotion& truth) {
  for (int side = 0; side < 2; ++side) {
    const std::vector<FootSensor>& sensors = feet_[side];
    if (sensors.size() != 4) continue;
    const TrueMotion::FootLoad& load = truth.feet[side];
    std::array<double, 4> shares{0, 0, 0, 0};
    if (load.force > 0) {
      shares =
          corner_shares({sensors[0].place, sensors[1].place, sensors[2].place, sensors[3].place},
                        load.moment / load.force);
    }
    for (int i = 0; i < 4; ++i) {
      double force = shares[i] * load.force;
      if (!options_.is_ideal) {
        force *= 1 + options_.foot_force_noise * random_.normal();
        force = std::round(force / options_.foot_force_step) * options_.foot_force_step;
        force = std::clamp(force, 0.0, options_.foot_force_range);
      }
      readings_.foot_force[sensors[i].index] = force;
    }
  }
}

}  // namespace nao::sim
