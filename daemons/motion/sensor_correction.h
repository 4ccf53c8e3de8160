#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/calibration.h"
#include "daemons/motion/estimator/foot_pressure.h"
#include "daemons/motion/sensors.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Corrects a robot's sensors, and its servos' targets, by its calibration: the rest of the motion
 * core works with the model's robot only. Allocates no memory after construction. */
class SensorCorrection {
 public:
  /** @param calibration  Calibration of the robot; Calibration(model): nothing is corrected. */
  SensorCorrection(const RobotModel& model, const Calibration& calibration);

  /** Converts readings to those of the model's sensors, and the servos' targets to the model's
   * angles. A dead foot sensor gets the force that a linear pressure through the other sensors of
   * its foot implies. */
  void correct(Sensors& sensors) const;

  /** Converts the model's angles to the servos' targets. @param position  rad, (num_motors). */
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
