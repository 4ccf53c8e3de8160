#pragma once

#include <Eigen/Geometry>

namespace nao::motion {

/** Orientation of the torso from gyroscope and accelerometer: a complementary filter that
 * integrates the gyroscope and turns slowly to where the accelerometer sees up.
 *
 * Source: Mahony, Hamel, Pflimlin, "Nonlinear complementary filters on the special orthogonal
 * group", IEEE TAC 53(5), 2008, the explicit filter with bias (eq. 48). Heading is the integrated
 * gyroscope alone, less its bias, which the filter learns about the level axes always and about the
 * vertical one while the robot rests. */
class OrientationFilter {
 public:
  /** Starts at the next update(), with heading 0: upright as the accelerometer sees it or, if that
   * shows more than gravity, as this estimate of somebody else's has it. */
  void reset(const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity()) {
    orientation_ = orientation;
    is_started_ = false;
  }

  /** Takes in one measurement.
   * @param gyroscope      rad/s, torso frame. @param accelerometer  m/s^2, torso frame.
   * @param is_at_rest     True while nothing moves: what the gyroscope says then is its bias.
   * @param dt             s since the last measurement. */
  void update(const Eigen::Vector3d& gyroscope, const Eigen::Vector3d& accelerometer,
              bool is_at_rest, double dt);

  /** Re-expresses in a frame with z up a vector given in the torso frame. */
  const Eigen::Quaterniond& orientation() const { return orientation_; }
  /** Angular velocity less the bias, rad/s, torso frame. */
  const Eigen::Vector3d& angular_velocity() const { return angular_velocity_; }
  /** rad/s. */
  const Eigen::Vector3d& bias() const { return bias_; }

 private:
  bool is_started_ = false;
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
};

}  // namespace nao::motion
