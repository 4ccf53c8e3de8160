#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/constants.h"

namespace nao::motion {

/** Compares the direction of up by the robot's own roll and pitch with that by accelerometer and
 * gyroscope (OrientationFilter). If they differ for long, one of these sensors is wrong, and the
 * balance cannot be trusted. */
class OrientationCheck {
 public:
  /** One control step. @param reported, estimated  Torso in a frame with z up; headings do not
   * matter. @param dt  s. */
  void update(const Eigen::Quaterniond& reported, const Eigen::Quaterniond& estimated, double dt) {
    const Eigen::Vector3d up_reported = reported.conjugate() * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up_estimated = estimated.conjugate() * Eigen::Vector3d::UnitZ();
    difference_ = std::acos(std::clamp(up_reported.dot(up_estimated), -1.0, 1.0));
    const bool changes = is_in_doubt_ ? difference_ < kGreatest : difference_ > kGreatest;
    time_ = changes ? time_ + dt : 0;
    if (time_ < kTime) return;
    is_in_doubt_ = !is_in_doubt_;
    time_ = 0;
  }

  void reset() { *this = OrientationCheck(); }

  /** Angle between the two, rad, while they have differed by more than 5 degrees for a second, and
   * until they have agreed for one; else 0. */
  double doubt() const { return is_in_doubt_ ? std::max(difference_, kGreatest) : 0; }

 private:
  // rad and s. Specified; walks, falls and get-ups of 32 drawn robots reach 4.4 degrees, and 3.8
  // for a second.
  static constexpr double kGreatest = 5 * kDegree;
  static constexpr double kTime = 1;

  double difference_ = 0;
  /** For which the other state has held, s. */
  double time_ = 0;
  bool is_in_doubt_ = false;
};

}  // namespace nao::motion
