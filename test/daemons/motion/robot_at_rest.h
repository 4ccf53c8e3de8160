#pragma once

#include <string>

#include "daemons/motion/estimator/state_estimator.h"
#include "daemons/motion/generators/motion_generator.h"
#include "test/daemons/motion/perfect_robot.h"

namespace nao::motion {

/** Context and targets of a robot at rest, for tests of single parts of the core. */
class RobotAtRest {
 public:
  explicit RobotAtRest(const std::string& posture = "StandInit", const MotionOptions& options = {})
      : options_(options), sensors_(PerfectRobot(posture).sensors()) {
    targets_.position = sensors_.position;
    targets_.velocity.assign(sensors_.position.size(), 0.0);
    targets_.stiffness = sensors_.stiffness;
    measure();
  }

  /** Lays it onto a side, at any joint angles. @param up_in_torso  Unit. */
  void lay_down(const Eigen::Vector3d& up_in_torso) {
    sensors_.accelerometer_torso = kGravity * up_in_torso;
    measure();
  }

  /** Restarts the estimate of the state from the sensors. */
  void measure() {
    estimator_.reset();
    estimator_.update(sensors_, 0.01);
  }

  Sensors& sensors() { return sensors_; }
  JointTargets& targets() { return targets_; }
  const RobotState& state() const { return estimator_.state(); }
  MotionContext context(double dt = 0) const {
    return {nao_model(), options_, sensors_, estimator_.state(), estimator_.kinematics(), dt};
  }

 private:
  MotionOptions options_;
  Sensors sensors_;
  StateEstimator estimator_{nao_model()};
  JointTargets targets_;
};

}  // namespace nao::motion
