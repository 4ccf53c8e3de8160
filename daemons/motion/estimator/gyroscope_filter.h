#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace nao::motion {

/** Low-pass filter of first order for the torso's angular velocity, rad/s, torso frame. */
class GyroscopeFilter {
 public:
  void reset() { value_.setZero(); }
  void update(const Eigen::Vector3d& angular_velocity, double dt) {
    value_ += std::min(1.0, dt / kTimeConstant) * (angular_velocity - value_);
  }
  const Eigen::Vector3d& value() const { return value_; }

 private:
  // s. Chosen: longer than a control period, so that the noise of single samples is attenuated, and
  // a tenth of the pendulum's time constant (1 / omega = 0.16 s), so that feedback is not delayed.
  static constexpr double kTimeConstant = 0.015;

  Eigen::Vector3d value_ = Eigen::Vector3d::Zero();
};

}  // namespace nao::motion
