#include "daemons/vision/ball_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/ball_rolling.h"

namespace nao::vision {
namespace {

/** Number of measurements in succession that restart the filter if they do not fit and agree within
 * this distance, m. */
constexpr int kRestart = 3;

}  // namespace

// Kalman filter with the state (position, velocity) in odometry, m and m/s; the rolling
// deceleration is the deterministic part of the model.
void BallFilter::predict(int64_t utime) {
  const int64_t elapsed = utime - utime_;
  utime_ = utime;
  if (!estimate_.is_known) return;
  // Time runs backwards if the simulation was restarted.
  if (elapsed < 0 || utime - estimate_.seen_utime > std::llround(1e6 * parameters_.forget_time)) {
    estimate_ = {};
    num_rejected_ = 0;
    return;
  }
  const double dt = 1e-6 * static_cast<double>(elapsed);
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  transition(0, 2) = transition(1, 3) = dt;
  Eigen::Vector4d& state = estimate_.state;
  const double speed = state.tail<2>().norm();
  if (speed > 0) {
    // Exact for constant deceleration until it stops.
    const double time = std::min(dt, speed / kBallRollingDeceleration);
    const Eigen::Vector2d direction = state.tail<2>() / speed;
    state.head<2>() += direction * (speed * time - 0.5 * kBallRollingDeceleration * time * time);
    state.tail<2>() = direction * std::max(0.0, speed - kBallRollingDeceleration * dt);
  }
  Eigen::Matrix4d& P = estimate_.covariance;
  P = (transition * P * transition.transpose()).eval();
  // White acceleration noise, integrated over the step.
  for (int axis = 0; axis < 2; ++axis) {
    P(axis, axis) += parameters_.acceleration_density * dt * dt * dt / 3;
    P(axis, axis + 2) += parameters_.acceleration_density * dt * dt / 2;
    P(axis + 2, axis) += parameters_.acceleration_density * dt * dt / 2;
    P(axis + 2, axis + 2) += parameters_.acceleration_density * dt;
  }
}

void BallFilter::start(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance) {
  estimate_ = {};
  estimate_.is_known = true;
  estimate_.seen_utime = utime_;
  estimate_.state << position, 0, 0;
  estimate_.covariance.topLeftCorner<2, 2>() = covariance;
  estimate_.covariance.bottomRightCorner<2, 2>() =
      Eigen::Matrix2d::Identity() * parameters_.velocity_sigma * parameters_.velocity_sigma;
  num_rejected_ = 0;
  surprise_.setZero();
}

// The velocity may have changed by `velocity_sigma` at the kick; position and velocity after it are
// correlated by the time since then.
void BallFilter::expect_kick() {
  const double dt =
      std::min(1e-6 * static_cast<double>(utime_ - kick_utime_), parameters_.kick_time);
  const Eigen::Matrix2d variance =
      Eigen::Matrix2d::Identity() * parameters_.velocity_sigma * parameters_.velocity_sigma;
  Eigen::Matrix4d& P = estimate_.covariance;
  P.topLeftCorner<2, 2>() += dt * dt * variance;
  P.topRightCorner<2, 2>() += dt * variance;
  P.bottomLeftCorner<2, 2>() += dt * variance;
  P.bottomRightCorner<2, 2>() += variance;
}

void BallFilter::update(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance) {
  if (!position.allFinite() || !covariance.allFinite()) return;
  if (!estimate_.is_known) {
    start(position, covariance);
    return;
  }
  // Innovation covariance S of the measured position.
  Eigen::Matrix2d S = estimate_.covariance.topLeftCorner<2, 2>() + covariance;
  const Eigen::Vector2d innovation = position - estimate_.state.head<2>();
  const bool was_surprised = surprise_.dot(innovation) > 0;
  const bool is_surprised = innovation.dot(S.inverse() * innovation) > parameters_.surprise;
  if (is_surprised && was_surprised) {
    expect_kick();
    S = estimate_.covariance.topLeftCorner<2, 2>() + covariance;
  } else if (is_surprised) {
    kick_utime_ = estimate_.seen_utime;
  }
  surprise_ = is_surprised && !was_surprised ? innovation : Eigen::Vector2d::Zero();
  const Eigen::Matrix4d P = estimate_.covariance;
  // Mahalanobis distance beyond the gate: an outlier, or the ball was moved. Several outliers in
  // agreement restart the filter at their place.
  if (innovation.dot(S.inverse() * innovation) > parameters_.gate) {
    const bool agrees = num_rejected_ > 0 && (position - rejected_).norm() < parameters_.agreement;
    num_rejected_ = agrees ? num_rejected_ + 1 : 1;
    rejected_ = position;
    if (num_rejected_ >= kRestart) start(position, covariance);
    return;
  }
  num_rejected_ = 0;
  // Kalman gain K = P H^T S^-1 with H = [1 0].
  const Eigen::Matrix<double, 4, 2> gain = P.leftCols<2>() * S.inverse();
  estimate_.state += gain * innovation;
  // Joseph form: stays symmetric and positive definite.
  Eigen::Matrix4d factor = Eigen::Matrix4d::Identity();
  factor.leftCols<2>() -= gain;
  estimate_.covariance = factor * P * factor.transpose() + gain * covariance * gain.transpose();
  estimate_.seen_utime = utime_;

  const double speed = estimate_.state.tail<2>().norm();
  const double sigma = std::sqrt(std::max(estimate_.covariance(2, 2), estimate_.covariance(3, 3)));
  // Hysteresis, so that a slow ball does not alternate.
  if (estimate_.is_rolling) {
    estimate_.is_rolling = speed > 0.5 * parameters_.rolling_speed;
  } else {
    estimate_.is_rolling =
        speed > parameters_.rolling_speed && speed > parameters_.rolling_sigmas * sigma;
  }
}

}  // namespace nao::vision
