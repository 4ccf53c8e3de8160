#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "common/constants.h"

namespace nao::motion {

/** Compares the direction of up by the robot's own roll and pitch with that by accelerometer and
 * gyroscope (OrientationFilter). If they part, one of these sensors is wrong, and the balance
 * cannot be trusted.
 *
 * The two filters drift apart slowly in a walk, and at once in a fall, whose rates exceed the
 * gyroscope's range: the difference counts from its own mean, which follows it slowly, and at once
 * while the robot lies. */
class OrientationCheck {
 public:
  /** One control step. @param reported, estimated  Torso in a frame with z up; headings do not
   * matter. @param dt  s. */
  void update(const Eigen::Quaterniond& reported, const Eigen::Quaterniond& estimated, double dt) {
    const Eigen::Vector3d up = estimated.conjugate() * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d difference = (reported.conjugate() * Eigen::Vector3d::UnitZ()).cross(up);
    if (up.z() < kUpright) {
      mean_ = difference;
      time_ = 0;
      return;
    }
    if (!is_in_doubt_) mean_ += (difference - mean_) * std::min(1.0, dt / kMeanTime);
    // For angles of this size a sine is the angle.
    doubt_ = (difference - mean_).norm();
    const bool changes = is_in_doubt_ ? doubt_ < kGreatest : doubt_ > kGreatest;
    time_ = changes ? time_ + dt : 0;
    if (time_ < kTime) return;
    is_in_doubt_ = !is_in_doubt_;
    time_ = 0;
  }

  void reset() { *this = OrientationCheck(); }

  /** Angle between the two, rad, from when they have differed by more than 5 degrees for a second
   * until they have agreed for one; else 0. */
  double doubt() const { return is_in_doubt_ ? std::max(doubt_, kGreatest) : 0; }

 private:
  // rad and s: specified.
  static constexpr double kGreatest = 5 * kDegree;
  static constexpr double kTime = 1;
  // s. Chosen: an error of 7 degrees is found, and the drift of the simulated unit (0.1 1/s) is
  // not.
  static constexpr double kMeanTime = 8;
  // Cosine of the tilt of a robot that lies or falls, 45 degrees.
  static constexpr double kUpright = 0.7;

  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  double doubt_ = 0;
  /** For which the other state has held, s. */
  double time_ = 0;
  bool is_in_doubt_ = false;
};

}  // namespace nao::motion
