#include "sim/lola_robot.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/constants.h"

namespace nao::sim {
namespace {

/** Values of a robot in good condition that the physics does not compute: charge, battery's status
 * while it is not charging, current of the electronics, A, and temperatures, degrees Celsius.
 * Status and motors' temperature as recorded from robots; the others assumed. */
constexpr float kCharge = 0.9f;
constexpr float kNotCharging = -32724;
constexpr float kIdleCurrent = -1.2f;
constexpr float kBatteryTemperature = 35;
constexpr float kMotorTemperature = 38;
/** A motor's temperature rises by this much for each A^2 that it draws for long, degrees, and
 * follows with this time constant, s. Assumed: 0.8 A, that of a standing robot's knee, makes it
 * hand-warm in minutes. */
constexpr double kHeatingPerSquareAmpere = 15;
constexpr double kHeatingTime = 300;
/** Reading of a sonar that sees nothing, m, and of one that is switched off. Assumed. */
constexpr float kNothingInRange = 2.55f;
constexpr float kSonarOff = 0;

bool is_finite(float value) {
  return std::isfinite(value);
}
bool is_finite(bool /*value*/) {
  return true;
}

}  // namespace

LolaRobot::LolaRobot(const RobotModel& model)
    : map_(LolaMap::load(model)), motor_names_(model.motor_names()) {
  state_.temperature.fill(kMotorTemperature);
  state_.battery = {kCharge, kNotCharging, kIdleCurrent, kBatteryTemperature};
  // Ids of 20 and versions of 5 characters, as every robot has: foreign clients expect their
  // lengths.
  state_.robot_config = {"P0000000000000000000", "6.0.0", "P0000000000000000000", "6.0.0"};
}

void LolaRobot::update(const SensorReadings& sensed, const MotorTargets& targets, double period) {
  read_joints(sensed, targets, period);
  const bool is_first = sensed.tick == 0;
  for (int i = 0; i < 3; ++i) {
    // A frame comes every 12 ms; the unit is read in turn, the accelerometer in even frames and the
    // gyroscope in odd ones, and the other value is repeated. The factors map the torso frame to
    // LoLA's axes.
    const auto axis = static_cast<size_t>(i);
    if (is_first || sensed.tick % 2 == 0) {
      state_.accelerometer[axis] =
          static_cast<float>(map_.accelerometer_sign[axis] * sensed.accelerometer[i]);
    }
    if (is_first || sensed.tick % 2 == 1) {
      state_.gyroscope[axis] = static_cast<float>(map_.gyroscope_sign[axis] * sensed.gyroscope[i]);
    }
  }
  // With R = Rz(yaw) Ry(pitch) Rx(roll): R(2,0) = -sin(pitch), R(2,1) / R(2,2) = tan(roll). The
  // clamp is for rounding. Heading is not reported.
  // Orientation as heading, then pitch, then roll about the axes that turn along: R = Rz Ry Rx.
  const Eigen::Matrix3d rotation = sensed.orientation.toRotationMatrix();
  state_.angles[0] = static_cast<float>(std::atan2(rotation(2, 1), rotation(2, 2)));
  state_.angles[1] = static_cast<float>(-std::asin(std::clamp(rotation(2, 0), -1.0, 1.0)));
  for (size_t i = 0; i < map_.foot_sensors.size(); ++i) {
    // LoLA reports foot forces in kg.
    state_.fsr[i] = static_cast<float>(sensed.foot_force[map_.foot_sensors[i]] / kGravity);
  }
  // A touch lasts for a number of ticks, so that a client that reads every frame cannot miss it.
  for (size_t i = 0; i < touched_ticks_.size(); ++i) {
    state_.touch[i] = touched_ticks_[i] > 0 ? 1 : 0;
    touched_ticks_[i] = std::max<int64_t>(0, touched_ticks_[i] - 1);
  }
  for (size_t i = 0; i < state_.sonar.size(); ++i) {
    state_.sonar[i] = held_.sonar && (*held_.sonar)[i] ? kNothingInRange : kSonarOff;
  }
}

void LolaRobot::read_joints(const SensorReadings& sensed, const MotorTargets& targets,
                            double period) {
  const auto span = [](const Eigen::VectorXd& v) {
    return std::span<const double>(v.data(), static_cast<size_t>(v.size()));
  };
  state_.position = map_.to_lola(span(sensed.position), true);
  state_.stiffness = map_.to_lola(span(targets.stiffness), false);
  state_.battery[2] = kIdleCurrent;
  // Current |torque| / torque constant; the electronics' current and all motors' discharge the
  // battery (negative current). Heating is a first-order lag of the squared current.
  for (size_t i = 0; i < kLolaJoints; ++i) {
    const double current = std::abs(sensed.torque[map_.joints[i].motor]) / map_.torque_per_current;
    state_.current[i] = static_cast<float>(current);
    state_.battery[2] -= state_.current[i];
    const double warmer =
        kMotorTemperature + kHeatingPerSquareAmpere * current * current - state_.temperature[i];
    state_.temperature[i] += static_cast<float>(warmer * period / kHeatingTime);
  }
}

// A LoLA message may lack keys, or have values that are not finite; these keep the last value. The
// resulting command is complete, as if it had come over the bus.
JointCommand LolaRobot::take(const LolaCommand& command, const MotorTargets& targets,
                             int64_t tick) {
  // Pairs of new and held values: key by key, value by value.
  const auto merge = [](const auto& news, auto& held) {
    if (!news) return;
    if (!held) held.emplace();
    for (size_t i = 0; i < news->size(); ++i) {
      if (is_finite((*news)[i])) (*held)[i] = (*news)[i];
    }
  };
  JointCommand result;
  result.tick = tick;
  result.names = motor_names_;
  result.position.assign(targets.position.data(),
                         targets.position.data() + targets.position.size());
  result.stiffness.assign(targets.stiffness.data(),
                          targets.stiffness.data() + targets.stiffness.size());
  // A robot that was placed elsewhere has other targets than the last command's.
  held_.position = map_.to_lola(result.position, true);
  held_.stiffness = map_.to_lola(result.stiffness, false);
  for_each_pair(command, held_, merge);
  map_.from_lola(*held_.position, true, result.position);
  map_.from_lola(*held_.stiffness, false, result.stiffness);
  // Below 0 is limp, too.
  for (double& stiffness : result.stiffness) stiffness = std::clamp(stiffness, 0.0, 1.0);
  return result;
}

bool LolaRobot::touch(const std::string& name, int64_t num_ticks) {
  // An unknown name is the caller's error: false.
  const auto found = std::find(map_.touch.begin(), map_.touch.end(), name);
  if (found == map_.touch.end()) return false;
  touched_ticks_[static_cast<size_t>(found - map_.touch.begin())] = num_ticks;
  return true;
}

}  // namespace nao::sim
