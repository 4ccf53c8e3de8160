#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "lola/frame.h"
#include "lola/lola_map.h"
#include "robot_model/robot_model.h"

namespace nao::robot {

/** Contents of a frame, in the units, signs and order of sensor_state_t and body_state_t. */
struct Measurement {
  /** rad (hands: opening), rad/s, fraction, degrees Celsius, A; (num_motors), motor order. */
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> stiffness;
  std::vector<double> temperature;
  std::vector<double> current;
  /** LoLA's: 0 normal, 1 hot, 2 reduced, 3 off. */
  std::vector<int> status;
  /** Specific force, m/s^2, and angular velocity, rad/s, torso frame. */
  Eigen::Vector3d accelerometer{0, 0, 9.81};
  Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();
  bool is_accelerometer_new = true;
  bool is_gyroscope_new = true;
  /** Tilt of the torso as the robot estimates it, rad. */
  double roll = 0;
  double pitch = 0;
  /** Torso in the world: that tilt, and the gyroscope's integrated heading. */
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /** N, in the order of RobotModel::foot_sensors(). */
  std::vector<double> foot_force;
  /** In LolaMap's order. */
  std::array<bool, 14> is_touched{};
  std::array<double, 2> sonar_range{};
  /** 0 to 1; A, positive while charging; degrees Celsius. */
  double battery_charge = 1;
  double battery_current = 0;
  double battery_temperature = 0;

  /** Greatest of |roll| and |pitch|, rad. */
  double tilt() const;
};

/** Converts frames. Values that are not finite keep the last ones. Allocates nothing in read(). */
class MeasurementReader {
 public:
  /** @param model, map  Must outlive this. */
  MeasurementReader(const RobotModel& model, const LolaMap& map);

  /** The next frame is the first of a connection: velocities are 0, the heading begins at 0. */
  void reset() { is_first_ = true; }
  /** @param dt  Time since the last frame, s. */
  const Measurement& read(const LolaState& state, double dt);
  const Measurement& measurement() const { return measurement_; }

 private:
  void read_joints(const LolaState& state, double dt);
  void read_inertial_unit(const LolaState& state, double dt);

  const LolaMap& map_;
  Measurement measurement_;
  std::vector<double> last_position_;
  std::array<float, 3> last_accelerometer_{};
  std::array<float, 3> last_gyroscope_{};
  double heading_ = 0;
  bool is_first_ = true;
};

}  // namespace nao::robot
