#include "daemons/motion/estimator/orientation_filter.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "common/rotation.h"
#include "kinematics/pose2.h"

namespace nao::motion {
namespace {

// Proportional gain k_P, 1/s. Chosen: at 0.5 the accelerations of a footstep (a few m/s^2 for a
// tenth of a second) tilt the estimate by hundredths of a radian.
constexpr double kTiltGain = 0.5;
// Integral gain k_I, 1/s^2. Chosen: below k_P^2 / 4 = 0.0625, above which the correction of tilt
// and bias oscillates.
constexpr double kBiasGain = 0.02;
// Both until the bias has been measured at rest: a robot may walk before it has ever rested, and
// its tilt is wrong by the bias over k_P. Chosen: of 200 used robots (real.yaml, seeds 501-700)
// that walk after a second of standing, 192 walk sideways with the gains above and 199 with these.
constexpr double kFirstTiltGain = 1.0;
constexpr double kFirstBiasGain = 0.1;
// Time of measuring at rest after which they end, s. Chosen: averages ten measurements.
constexpr double kFirstRest = 0.1;
// Deviation of |a| from gravity at which the weight q of the accelerometer reaches 0, m/s^2.
// Chosen: a third of gravity.
constexpr double kZeroWeightDeviation = 3.0;
// Deviation of |a| from gravity up to which it counts as gravity alone, m/s^2. Chosen: ten standard
// deviations of the simulated accelerometer's bias.
constexpr double kRestDeviation = 0.5;
// Angle between estimated and measured up at rest at which the estimate is replaced, rad. Chosen:
// far above the filter's error, below any change of the side on which a robot lies.
constexpr double kLostTilt = 0.3;
// Rest after which the estimates are corrected, s. Chosen: longer than a turning point of a sway.
constexpr double kSettlingTime = 0.3;
// The same for the bias until it has been learnt. Chosen: a robot that was put down sways with a
// period of 1 s.
constexpr double kFirstSettlingTime = 0.6;

bool measures_gravity(const Eigen::Vector3d& accelerometer) {
  return std::abs(accelerometer.norm() - kGravity) < kRestDeviation;
}

}  // namespace

void OrientationFilter::update(const Eigen::Vector3d& gyroscope,
                               const Eigen::Vector3d& accelerometer, double rest_time, double dt) {
  if (!is_started_) {
    start(gyroscope, accelerometer);
    return;
  }
  if (rest_time > kSettlingTime) recover(accelerometer);
  if (rest_time > (has_learnt_bias() ? kSettlingTime : kFirstSettlingTime)) {
    // At first the mean of all measurements, then of the latest.
    learnt_time_ = std::min(learnt_time_ + dt, kRestTimeConstant);
    bias_ += (gyroscope - bias_) * std::min(1.0, dt / learnt_time_);
  }
  const double norm = accelerometer.norm();
  // 1 at |a| = g, falling linearly: an accelerating robot does not measure the vertical.
  const double weight = std::max(0.0, 1 - std::abs(norm - kGravity) / kZeroWeightDeviation);
  Eigen::Vector3d correction = Eigen::Vector3d::Zero();
  if (weight > 0) {
    const Eigen::Vector3d up_in_torso = orientation_.conjugate() * Eigen::Vector3d::UnitZ();
    // Axis, scaled with the sine of the angle, about which the estimate must rotate in the torso's
    // axes: measured times estimated vertical (Mahony's error term).
    const Eigen::Vector3d error = (accelerometer / norm).cross(up_in_torso);
    const bool has_rested = learnt_time_ >= kFirstRest;
    correction = (has_rested ? kTiltGain : kFirstTiltGain) * weight * error;
    bias_ -= (has_rested ? kBiasGain : kFirstBiasGain) * weight * error * dt;
  }
  // Clamped: a bias that runs away would turn the robot's heading without end.
  bias_ = bias_.cwiseMax(-kMaxBias).cwiseMin(kMaxBias);
  angular_velocity_ = gyroscope - bias_;
  // Exponential map of the step's rotation vector.
  const Eigen::Vector3d rotation = (angular_velocity_ + correction) * dt;
  const double angle = rotation.norm();
  if (angle > 0) {
    orientation_ = orientation_ * Eigen::AngleAxisd(angle, rotation / angle);
    orientation_.normalize();
  }
}

void OrientationFilter::start(const Eigen::Vector3d& gyroscope,
                              const Eigen::Vector3d& accelerometer) {
  if (measures_gravity(accelerometer)) {
    orientation_ = rotation_between(accelerometer, Eigen::Vector3d::UnitZ());
  }
  // The shortest rotation to upright has a small heading; the heading starts at 0.
  const Eigen::Matrix3d R = orientation_.toRotationMatrix();
  const double heading = heading_of(R);
  orientation_ = Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) * orientation_;
  // Without a measurement of gravity (while the robot falls) the given orientation is kept.
  angular_velocity_ = gyroscope - bias_;
  is_started_ = true;
}

void OrientationFilter::recover(const Eigen::Vector3d& accelerometer) {
  const Eigen::Vector3d up_before = orientation_.conjugate() * Eigen::Vector3d::UnitZ();
  if (!measures_gravity(accelerometer)) return;
  if (accelerometer.dot(up_before) >= accelerometer.norm() * std::cos(kLostTilt)) return;
  // Nothing rotated, but the direction of up has changed: the robot was placed elsewhere.
  const Eigen::Quaterniond correction =
      rotation_between(orientation_ * accelerometer, Eigen::Vector3d::UnitZ());
  orientation_ = correction * orientation_;
}

}  // namespace nao::motion
