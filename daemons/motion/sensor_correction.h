#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/calibration.h"
#include "daemons/motion/estimator/foot_pressure.h"
#include "daemons/motion/sensors.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Corrects a robot's sensors, and its servos' targets, by its calibration: the rest of the motion
 * core knows the robot of the model only. Takes no memory after construction. */
class SensorCorrection {
 public:
  /** @param calibration  Calibration of the robot; Calibration(model): nothing is corrected. */
  SensorCorrection(const RobotModel& model, const Calibration& calibration);

  /** Readings to what the model's sensors would have read; the servos' targets to the model's
   * angles. A dead foot sensor gets the force that a pressure that is linear in the position gives
   * it, from the other sensors of its foot. */
  void correct(Sensors& sensors) const;

  /** The model's angles to the servos' targets. @param position  rad, (num_motors). */
  void to_servos(std::vector<double>& position) const {
    for (size_t i = 0; i < position.size(); ++i) position[i] += calibration_.joint_zero[i];
  }

 private:
  Calibration calibration_;
  FootPressure pressure_;
  /** For each foot sensor, whether its scale is 0. */
  std::vector<bool> is_dead_;
  /** Re-expresses in the torso frame a vector given in the inertial unit's axes. */
  Eigen::Matrix3d torso_from_unit_;
};

}  // namespace nao::motion
