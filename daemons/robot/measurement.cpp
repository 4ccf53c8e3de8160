#include "daemons/robot/measurement.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"

namespace nao::robot {
namespace {

/** Least |cos(pitch)| with which the rate of the heading is computed: at a pitch of 90 degrees
 * there is no heading. */
constexpr double kLeastCosine = 0.2;

// Values that are not finite keep the last good one.
void take(double value, double& result) {
  if (std::isfinite(value)) result = value;
}

template <size_t N>
void take(const LolaMap& map, const std::array<float, N>& values, bool is_angle,
          std::vector<double>& result) {
  for (size_t i = 0; i < N; ++i) {
    const double sign = is_angle ? map.joints[i].sign : 1;
    take(sign * static_cast<double>(values[i]), result[static_cast<size_t>(map.joints[i].motor)]);
  }
}

}  // namespace

// Roll and pitch are used instead of the angle to the vertical because the thresholds of other
// teams refer to them.
double Measurement::tilt() const {
  return std::max(std::abs(roll), std::abs(pitch));
}

MeasurementReader::MeasurementReader(const RobotModel& model, const LolaMap& map) : map_(map) {
  const auto num_motors = static_cast<size_t>(model.num_motors());
  for (auto* values : {&measurement_.position, &measurement_.velocity, &measurement_.stiffness,
                       &measurement_.temperature, &measurement_.current, &last_position_}) {
    values->assign(num_motors, 0);
  }
  measurement_.status.assign(num_motors, 0);
  measurement_.foot_force.assign(model.foot_sensors().size(), 0);
}

const Measurement& MeasurementReader::read(const LolaState& state, double dt) {
  // The heading is a sum over the gyroscope's rates and starts at 0.
  if (is_first_) heading_ = 0;
  read_joints(state, dt);
  read_inertial_unit(state, dt);
  Measurement& result = measurement_;
  for (size_t i = 0; i < map_.foot_sensors.size(); ++i) {
    // Noise may make the reading of an unloaded sensor negative.
    take(std::max(0.0, static_cast<double>(state.fsr[i]) * kGravity),
         result.foot_force[static_cast<size_t>(map_.foot_sensors[i])]);
  }
  for (size_t i = 0; i < state.touch.size(); ++i) result.is_touched[i] = state.touch[i] > 0.5f;
  for (size_t i = 0; i < state.sonar.size(); ++i) take(state.sonar[i], result.sonar_range[i]);
  take(state.battery[0], result.battery_charge);
  take(state.battery[2], result.battery_current);
  take(state.battery[3], result.battery_temperature);
  is_first_ = false;
  return result;
}

void MeasurementReader::read_joints(const LolaState& state, double dt) {
  Measurement& result = measurement_;
  last_position_ = result.position;
  take(map_, state.position, true, result.position);
  take(map_, state.stiffness, false, result.stiffness);
  take(map_, state.temperature, false, result.temperature);
  take(map_, state.current, false, result.current);
  for (size_t i = 0; i < kLolaJoints; ++i) {
    result.status[static_cast<size_t>(map_.joints[i].motor)] = state.status[i];
  }
  for (size_t i = 0; i < result.position.size(); ++i) {
    // LoLA sends no velocities.
    result.velocity[i] = is_first_ || dt <= 0 ? 0 : (result.position[i] - last_position_[i]) / dt;
  }
}

void MeasurementReader::read_inertial_unit(const LolaState& state, double dt) {
  Measurement& result = measurement_;
  // The two are refreshed in turn; a repeated reading has the same bits.
  result.is_accelerometer_new = is_first_ || state.accelerometer != last_accelerometer_;
  result.is_gyroscope_new = is_first_ || state.gyroscope != last_gyroscope_;
  last_accelerometer_ = state.accelerometer;
  last_gyroscope_ = state.gyroscope;
  for (size_t i = 0; i < 3; ++i) {
    take(map_.accelerometer_sign[i] * static_cast<double>(state.accelerometer[i]),
         result.accelerometer[static_cast<long>(i)]);
    take(map_.gyroscope_sign[i] * static_cast<double>(state.gyroscope[i]),
         result.gyroscope[static_cast<long>(i)]);
  }
  take(state.angles[0], result.roll);
  take(state.angles[1], result.pitch);
  // Rate of the heading psi from body rates: psi' = (w_y sin(roll) + w_z cos(roll)) / cos(pitch).
  const double cosine = std::cos(result.pitch);
  // The divisor keeps its sign and at least kLeastCosine: near a pitch of 90 degrees the rate would
  // be infinite.
  const double divisor = std::copysign(std::max(std::abs(cosine), kLeastCosine), cosine);
  if (!is_first_) {
    heading_ += dt *
                (result.gyroscope.y() * std::sin(result.roll) +
                 result.gyroscope.z() * std::cos(result.roll)) /
                divisor;
  }
  // Into [-pi, pi].
  heading_ = std::remainder(heading_, 2 * M_PI);
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  result.orientation = AngleAxisd(heading_, Vector3d::UnitZ()) *
                       AngleAxisd(result.pitch, Vector3d::UnitY()) *
                       AngleAxisd(result.roll, Vector3d::UnitX());
}

}  // namespace nao::robot
