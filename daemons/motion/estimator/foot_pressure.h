#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao::motion {

/** Infers the force on one sensor of a foot from the others: the pressure under a flat rigid sole
 * on an elastic floor is linear in the position. Allocates no memory after construction. */
class FootPressure {
 public:
  explicit FootPressure(const RobotModel& model);

  /** Force on a sensor that the other sensors of its foot imply, by least squares over those that
   * are not dead; at least 0. 0 if these are fewer than three or lie on a line.
   * @param force    N, (num_sensors), in the order of RobotModel::foot_sensors().
   * @param is_dead  (num_sensors). */
  double implied_force(size_t sensor, const std::vector<double>& force,
                       const std::vector<bool>& is_dead) const;
  /** Gives every dead sensor the force that the others imply. @param force  N, changed. */
  void replace_dead(const std::vector<bool>& is_dead, std::vector<double>& force) const;
  /** Indices of all sensors of the foot that a sensor belongs to; none if it is on no foot. */
  const std::vector<int>& sensors_of_foot(size_t sensor) const { return feet_[foot_[sensor]]; }
  size_t num_sensors() const { return terms_.size(); }

 private:
  /** Sensors of each foot; the last entry is empty, for sensors that are on no foot. */
  std::vector<std::vector<int>> feet_;
  /** Index into feet_, of each sensor. */
  std::vector<size_t> foot_;
  /** 1 and the position in the sole's frame, m: the terms of a linear pressure. */
  std::vector<Eigen::Vector3d> terms_;
};

}  // namespace nao::motion
