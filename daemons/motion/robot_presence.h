#pragma once

#include "daemons/motion/sensors.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Detects whether there is a robot, and whether it was restarted or placed elsewhere. */
class RobotPresence {
 public:
  enum class Change {
    kNone,
    /** The first sensor data after none. */
    kAppeared,
    /** Its control ticks restarted, or joints jumped: it was restarted or placed elsewhere. */
    kPlaced,
    /** No sensor data for the timeout. */
    kLost,
  };

  /** @param model  Must outlive this. @param timeout  Time without data after which there is no
   * robot, s. */
  RobotPresence(const RobotModel& model, double timeout) : model_(&model), timeout_(timeout) {}

  /** Sensor data have arrived. @param dt  Robot time since the last ones, s. */
  Change take(const Sensors& sensors, double dt);
  /** No sensor data have arrived. @param dt  Time since the last call of either function, s. */
  Change wait(double dt);

  bool has_robot() const { return has_robot_; }
  /** The newest ones; their initial values before the first take(). */
  const Sensors& sensors() const { return sensors_; }

 private:
  bool is_another(const Sensors& sensors, double dt) const;

  const RobotModel* model_;
  double timeout_;
  bool has_robot_ = false;
  /** Time since the last sensor data, s. */
  double silence_ = 0;
  Sensors sensors_;
};

}  // namespace nao::motion
