#include "daemons/motion/robot_presence.h"

#include <cmath>

namespace nao::motion {
namespace {

// Turn of a joint in one step beyond what its motor can do, rad, which means that the robot was
// placed elsewhere. Chosen: far above what the encoders' resolution of 0.1 degrees and an impact
// can make of a step.
constexpr double kPlacedAngle = 0.5;

}  // namespace

RobotPresence::Change RobotPresence::take(const Sensors& sensors, double dt) {
  // The first message after silence is always a new appearance, even of the same robot.
  Change change = Change::kNone;
  if (!has_robot_) {
    change = Change::kAppeared;
  } else if (is_another(sensors, dt)) {
    change = Change::kPlaced;
  }
  sensors_ = sensors;
  silence_ = 0;
  has_robot_ = true;
  return change;
}

RobotPresence::Change RobotPresence::wait(double dt) {
  silence_ += dt;
  if (!has_robot_ || silence_ < timeout_) return Change::kNone;
  has_robot_ = false;
  return Change::kLost;
}

bool RobotPresence::is_another(const Sensors& sensors, double dt) const {
  // Ticks count upwards: an earlier one is another robot or a reset simulation.
  if (sensors.tick < sensors_.tick) return true;
  for (int motor = 0; motor < model_->num_motors(); ++motor) {
    const double farthest = model_->motor_joint(motor).max_velocity * dt + kPlacedAngle;
    if (std::abs(sensors.position[motor] - sensors_.position[motor]) > farthest) return true;
  }
  return false;
}

}  // namespace nao::motion
