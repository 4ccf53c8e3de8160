#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "daemons/vision/vision_parameters.h"

namespace nao::vision {

/** Radius of the ball, m: 10 cm across, by the rules of the Standard Platform League. */
constexpr double kBallRadius = 0.05;

/** The ball as tracked over time, in the odometry frame O. */
struct BallEstimate {
  bool is_known = false;
  /** Robot time at which it was last seen, microseconds. */
  int64_t seen_utime = 0;
  /** x, y, m; vx, vy, m/s. */
  Eigen::Vector4d state = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  bool is_rolling = false;
};

/** Kalman filter of the ball's position and velocity.
 *
 * A rolling ball decelerates by a constant friction; random accelerations stand for kicks and for
 * the drift of the odometry. Two measurements in succession far to the same side show a kick, after
 * which the velocity is uncertain again. A measurement that does not fit is ignored, unless several
 * in succession agree with each other: then the ball was moved, and the filter restarts. */
class BallFilter {
 public:
  explicit BallFilter(
      const VisionParameters::BallFilter& parameters = VisionParameters::load().ball_filter)
      : parameters_(parameters) {}

  /** Advances the estimate to a time. A step back in time, or long without a sighting, resets it.
   * @param utime  Microseconds. */
  void predict(int64_t utime);

  /** Takes a position measured at the time of the last predict().
   * @param position  In O, m. @param covariance  m^2. */
  void update(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance);

  const BallEstimate& estimate() const { return estimate_; }
  void reset() { *this = BallFilter(parameters_); }

 private:
  void expect_kick();
  void start(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance);

  VisionParameters::BallFilter parameters_;
  BallEstimate estimate_;
  int64_t utime_ = 0;
  int num_rejected_ = 0;
  Eigen::Vector2d rejected_ = Eigen::Vector2d::Zero();
  /** Innovation of the last measurement if it was far from what was predicted, else zero; and time
   * of the last one before it, microseconds. */
  Eigen::Vector2d surprise_ = Eigen::Vector2d::Zero();
  int64_t kick_utime_ = 0;
};

}  // namespace nao::vision
