#pragma once

#include <vector>

#include "robot_model/robot_model.h"

namespace nao::robot {

/** The motion to the posture in which the motors need no torque: first the arms and the head, then
 * the legs. */
class SitDown {
 public:
  /** Duration, s, with a moment to come to rest. Robot soccer teams take 2 to 3 s. */
  static constexpr double kDuration = 3.0;

  explicit SitDown(const RobotModel& model);

  /** @param from  rad, (num_motors). */
  void begin(const std::vector<double>& from);
  /** @param dt  s. @param position  Gets the angles, rad, (num_motors). Allocates nothing. */
  void step(double dt, std::vector<double>& position);
  bool is_done() const { return time_ >= kDuration; }

 private:
  std::vector<double> from_;
  std::vector<double> to_;
  /** Joints of legs, motor order. */
  std::vector<bool> is_leg_;
  double time_ = kDuration;
};

}  // namespace nao::robot
