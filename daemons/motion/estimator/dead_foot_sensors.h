#pragma once

#include <vector>

#include "daemons/motion/estimator/foot_pressure.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Finds force sensors that read nothing while the others of their foot say that they are loaded,
 * and gives them the implied force. A dead sensor is the most harmful of the robot's sensing
 * errors: it moves the measured center of pressure by up to two centimeters.
 *
 * A sensor on the edge of a hole or a bump reads nothing, too. Therefore one that has ever been
 * seen loaded needs ten times the evidence. Allocates no memory after construction. */
class DeadFootSensors {
 public:
  explicit DeadFootSensors(const RobotModel& model);

  /** Takes in one tick. @param force  N, as measured; dead sensors get the implied force.
   * @param dt  s. */
  void update(std::vector<double>& force, double dt);
  const std::vector<bool>& is_dead() const { return is_dead_; }

 private:
  FootPressure pressure_;
  /** Least load on a foot with which its sensors are judged, N. */
  double least_load_;
  /** Time without a reading under load, s; for a sensor that has been loaded before, only since
   * its foot was put down. */
  std::vector<double> silent_time_;
  std::vector<bool> has_been_loaded_;
  std::vector<bool> is_dead_;
};

}  // namespace nao::motion
