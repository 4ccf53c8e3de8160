#include "daemons/motion/estimator/orientation_filter.h"

#include <algorithm>
#include <cmath>

namespace nao::motion {
namespace {

constexpr double kGravity = 9.81;

// How fast the estimate turns to the accelerometer's up, 1/s. Chosen: at 0.5 a step's accelerations
// (a few m/s^2 for a tenth of a second) tilt the estimate by hundredths of a radian.
constexpr double kTiltGain = 0.5;
// Faster in the first seconds' rest, when nothing better is known.
constexpr double kBiasGain = 0.02;
// Time constant of learning the bias at rest, s.
constexpr double kRestTimeConstant = 1.0;
// The accelerometer's word counts less the farther its size is from gravity, and nothing from here
// on, m/s^2.
constexpr double kAccelerationDoubt = 3.0;
// An estimate this far off while the robot rests is lost, rad; at rest the accelerometer is this
// near to gravity, m/s^2.
constexpr double kLostTilt = 0.3;
constexpr double kRestAccelerationError = 0.5;
constexpr double kMaxBias = 0.1;  // rad/s; a sensor that is off by more is broken

}  // namespace

void OrientationFilter::update(const Eigen::Vector3d& gyroscope,
                               const Eigen::Vector3d& accelerometer, bool is_at_rest, double dt) {
  const double norm = accelerometer.norm();
  if (!is_started_) {
    if (std::abs(norm - kGravity) < kRestAccelerationError) {
      orientation_ = Eigen::Quaterniond::FromTwoVectors(accelerometer, Eigen::Vector3d::UnitZ());
    }
    // The shortest turn upright has a little heading in it; heading starts at 0.
    const Eigen::Matrix3d R = orientation_.toRotationMatrix();
    const double heading = std::atan2(R(1, 0), R(0, 0));
    orientation_ = Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) * orientation_;
    angular_velocity_ = gyroscope - bias_;
    is_started_ = true;
    return;
  }
  const Eigen::Vector3d up_before = orientation_.conjugate() * Eigen::Vector3d::UnitZ();
  const bool is_gravity = std::abs(norm - kGravity) < kRestAccelerationError;
  if (is_at_rest && is_gravity && accelerometer.dot(up_before) < norm * std::cos(kLostTilt)) {
    // Nothing turned, and yet up is elsewhere: somebody has placed the robot anew.
    const Eigen::Quaterniond correction =
        Eigen::Quaterniond::FromTwoVectors(orientation_ * accelerometer, Eigen::Vector3d::UnitZ());
    orientation_ = correction * orientation_;
  }
  if (is_at_rest) {
    bias_ += (gyroscope - bias_) * std::min(1.0, dt / kRestTimeConstant);
  }
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();
  const double trust = std::max(0.0, 1 - std::abs(norm - kGravity) / kAccelerationDoubt);
  if (trust > 0) {
    const Eigen::Vector3d up_in_torso = orientation_.conjugate() * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d error = (accelerometer / norm).cross(up_in_torso);
    correction = kTiltGain * trust * error;
    bias_ -= kBiasGain * trust * error * dt;
  }
  bias_ = bias_.cwiseMax(-kMaxBias).cwiseMin(kMaxBias);
  angular_velocity_ = gyroscope - bias_;
  const Eigen::Vector3d turn = (angular_velocity_ + correction) * dt;
  const double angle = turn.norm();
  if (angle > 0) {
    orientation_ = orientation_ * Eigen::AngleAxisd(angle, turn / angle);
    orientation_.normalize();
  }
}

}  // namespace nao::motion
