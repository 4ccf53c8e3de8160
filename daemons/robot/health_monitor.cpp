#include "daemons/robot/health_monitor.h"
#include "common/constants.h"

#include <algorithm>
#include <cmath>

namespace nao::robot {
namespace {

/** Charges below which a warning is shown, and below which the robot sits down: rUNSWift and
 * Bembelbots. */
constexpr double kLowCharge = 0.25;
constexpr double kEmptyCharge = 0.1;
/** Temperature of a hot motor, degrees Celsius: rUNSWift. */
constexpr double kHotMotor = 75;
/** Least status of LoLA with which the robot reduces the torque by more than 30 %. */
constexpr int kReducedStatus = 2;
constexpr int kOffStatus = 3;
/** A dead motor: no current, though it is stiff and more than 2 degrees from its target, for 83
 * frames: rUNSWift. */
constexpr double kDeadTime = 1.0;
constexpr double kDeadDeviation = 2 * kDegree;
constexpr double kLeastCurrent = 1e-3;
constexpr double kLeastStiffness = 0.05;
/** Time for which a value must be bad, s. Chosen: longer than a peak of a step, shorter than a fall
 * from weak motors. */
constexpr double kConfirmTime = 0.5;

}  // namespace

HealthMonitor::HealthMonitor(int num_motors) : motors_(static_cast<size_t>(num_motors)) {}

// Conditions are counted by time, so that single bad readings have no effect. The first of several
// faults in this order is reported: a dead motor cannot wait.
void HealthMonitor::step(const Measurement& measured, const Targets& sent, double dt) {
  time_empty_ = measured.battery_charge < kEmptyCharge ? time_empty_ + dt : 0;
  is_battery_low_ = measured.battery_charge < kLowCharge;
  for (size_t i = 0; i < motors_.size(); ++i) watch(measured, sent, i, dt);
  const auto has_motor = [&](auto condition) {
    return std::any_of(motors_.begin(), motors_.end(), condition);
  };
  if (has_motor([](const MotorWatch& motor) { return motor.condition == Motor::kDead; })) {
    fault_ = Fault::kDeadMotor;
  } else if (time_empty_ > kConfirmTime) {
    fault_ = Fault::kBatteryLow;
  } else if (has_motor([](const MotorWatch& motor) { return motor.time_reduced > kConfirmTime; })) {
    fault_ = Fault::kHeat;
  } else {
    fault_ = Fault::kNone;
  }
}

void HealthMonitor::watch(const Measurement& measured, const Targets& sent, size_t motor,
                          double dt) {
  MotorWatch& watched = motors_[motor];
  const int status = measured.status[motor];
  watched.time_reduced = status >= kReducedStatus ? watched.time_reduced + dt : 0;
  const bool is_stiff =
      sent.stiffness[motor] > kLeastStiffness && measured.stiffness[motor] > kLeastStiffness;
  const bool is_off_target =
      std::abs(sent.position[motor] - measured.position[motor]) > kDeadDeviation;
  const bool is_without_current = std::abs(measured.current[motor]) < kLeastCurrent;
  // A stiff motor off its target must draw current; one that does not has lost its supply or its
  // driver.
  if (is_stiff && is_off_target && is_without_current) {
    watched.time_without_current += dt;
  } else if (!is_without_current || watched.time_without_current < kDeadTime) {
    // A motor that was found dead remains so until it draws current.
    watched.time_without_current = 0;
  }
  if (watched.time_without_current >= kDeadTime) {
    watched.condition = Motor::kDead;
  } else if (status >= kOffStatus) {
    watched.condition = Motor::kOff;
  } else if (status >= kReducedStatus) {
    watched.condition = Motor::kReduced;
  } else if (status > 0 || measured.temperature[motor] >= kHotMotor) {
    watched.condition = Motor::kHot;
  } else {
    watched.condition = Motor::kOk;
  }
}

std::vector<std::string> HealthMonitor::warnings() const {
  std::vector<std::string> codes;
  if (is_battery_low_) codes.emplace_back("battery-low");
  const auto has = [this](auto condition) {
    return std::any_of(motors_.begin(), motors_.end(),
                       [&](const MotorWatch& motor) { return condition(motor.condition); });
  };
  if (has([](Motor motor) { return motor != Motor::kOk && motor != Motor::kDead; })) {
    codes.emplace_back("joint-hot");
  }
  if (has([](Motor motor) { return motor == Motor::kDead; })) codes.emplace_back("joint-dead");
  return codes;
}

}  // namespace nao::robot
