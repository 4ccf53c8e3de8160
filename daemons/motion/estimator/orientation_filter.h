#pragma once

#include <Eigen/Geometry>

namespace nao::motion {

/** Estimates the orientation of the torso from gyroscope and accelerometer: an explicit
 * complementary filter with bias estimation.
 *
 * With the rotation R from the torso frame T to a frame O with z up, the measured angular velocity
 * w_m = w + b + noise with the bias b, and the measured specific force a, both in T:
 *
 *     v_hat = R^T e_z                          estimated direction of up in T
 *     e     = (a / |a|) x v_hat                error: rotates the estimate towards the measurement
 *     dR/dt = R [w_m - b + k_P q(|a|) e]_x     integration with proportional correction
 *     db/dt = -k_I q(|a|) e                    integral correction
 *
 * The weight q falls from 1 at |a| = g to 0 at |a| = g +- 3 m/s^2, since an accelerated torso does
 * not measure gravity alone. Gravity does not determine the heading, so the heading is the integral
 * of the gyroscope; the bias about the vertical axis is learnt while the robot rests, when w = 0.
 * Until it has rested, k_P and k_I are greater.
 *
 * Source: R. Mahony, T. Hamel, J.-M. Pflimlin, "Nonlinear complementary filters on the special
 * orthogonal group", IEEE Trans. Automatic Control 53(5), 2008, eq. 48. */
class OrientationFilter {
 public:
  /** Restarts at the next update(), with heading 0.
   * @param orientation  Initial estimate from another source; used if the accelerometer then
   * measures more than gravity. The bias is kept. */
  void reset(const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity()) {
    orientation_ = orientation;
    is_started_ = false;
  }

  /** Adds one measurement.
   * @param gyroscope      Angular velocity, rad/s, T.
   * @param accelerometer  Specific force, m/s^2, T: (0, 0, +g) upright at rest.
   * @param rest_time      For which nothing has moved, s: the gyroscope then measures its bias.
   * @param dt  Time since the last measurement, s. */
  void update(const Eigen::Vector3d& gyroscope, const Eigen::Vector3d& accelerometer,
              double rest_time, double dt);

  /** Re-expresses a vector given in T in O. */
  const Eigen::Quaterniond& orientation() const { return orientation_; }
  /** Angular velocity without the bias, rad/s, T. */
  const Eigen::Vector3d& angular_velocity() const { return angular_velocity_; }
  /** Estimated bias of the gyroscope, rad/s, T. */
  const Eigen::Vector3d& bias() const { return bias_; }
  /** Whether the robot has rested long enough for the bias to be known. */
  bool has_learnt_bias() const { return learnt_time_ >= kRestTimeConstant; }

  /** Largest bias that is estimated, rad/s. Chosen: 50 standard deviations of the simulated
   * gyroscope's bias; a sensor with more is broken. */
  static constexpr double kMaxBias = 0.1;

 private:
  /** Time constant with which the bias follows the gyroscope at rest, s. Chosen: averages a hundred
   * measurements, and is shorter than most rests between two motions. */
  static constexpr double kRestTimeConstant = 1.0;

  void start(const Eigen::Vector3d& gyroscope, const Eigen::Vector3d& accelerometer);
  /** Replaces an estimate that contradicts gravity at rest. */
  void recover(const Eigen::Vector3d& accelerometer);

  bool is_started_ = false;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
  /** Time for which the bias has been learnt at rest, s; at most the time constant. */
  double learnt_time_ = 0;
};

}  // namespace nao::motion
