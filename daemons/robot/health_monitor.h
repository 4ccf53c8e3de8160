#pragma once

#include <string>
#include <vector>

#include "daemons/robot/measurement.h"
#include "daemons/robot/targets.h"

namespace nao::robot {

/** Why the robot must not stay on its feet. */
enum class Fault { kNone, kBatteryLow, kHeat, kDeadMotor };

/** Watches battery and motors. */
class HealthMonitor {
 public:
  /** Condition of a motor, as body_state_t's JOINT_STATUS_*. */
  enum class Motor { kOk, kHot, kReduced, kOff, kDead };

  explicit HealthMonitor(int num_motors);

  /** @param sent  Targets that the servos have. @param dt  s. Allocates nothing. */
  void step(const Measurement& measured, const Targets& sent, double dt);

  Fault fault() const { return fault_; }
  Motor motor(int motor) const { return motors_[static_cast<size_t>(motor)].condition; }
  /** Codes for body_state_t. */
  std::vector<std::string> warnings() const;

 private:
  struct MotorWatch {
    Motor condition = Motor::kOk;
    /** Time without current though there is a deviation, and with reduced torque, s. */
    double time_without_current = 0;
    double time_reduced = 0;
  };

  void watch(const Measurement& measured, const Targets& sent, size_t motor, double dt);

  std::vector<MotorWatch> motors_;
  /** Time with a charge below the limit, s. */
  double time_empty_ = 0;
  bool is_battery_low_ = false;
  Fault fault_ = Fault::kNone;
};

}  // namespace nao::robot
