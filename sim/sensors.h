#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "common/constants.h"
#include "common/random.h"
#include "robot_model/robot_model.h"
#include "sim/foot_load.h"
#include "sim/robot_errors.h"

namespace nao::sim {

/** Readings of a robot's sensors at the end of a control tick, in motor and sensor order. */
struct SensorReadings {
  int64_t tick = 0;
  /** Since the robot was switched on, s. */
  double time = 0;
  /** Encoder angles, rad (hands: opening), and their change over the tick, rad/s. */
  Eigen::VectorXd position;
  Eigen::VectorXd velocity;
  /** Motors' torques, N m, mean over the tick. */
  Eigen::VectorXd torque;
  /** Specific force (acceleration minus gravity), m/s^2, and angular velocity, rad/s, in the torso
   * frame, means over the tick. */
  Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();
  /** Whether they were read in this tick; the last reading is repeated otherwise. */
  bool is_accelerometer_new = true;
  bool is_gyroscope_new = true;
  /** Torso in W as the inertial unit estimates it. */
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /** N, in the order of RobotModel::foot_sensors(), means over the tick. */
  Eigen::VectorXd foot_force;
};

/** The true values at the end of a control tick, and over it; as SensorReadings otherwise. */
struct TrueMotion {
  /** Positions of the motors, rad, which their encoders read. */
  Eigen::VectorXd position;
  Eigen::VectorXd torque;
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  /** Torso in a frame whose z axis is against gravity; on a level floor that is W. */
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  struct FootLoad {
    /** Force of the floor along the sole's normal, N, and its moment: force times its point of
     * attack in the sole's frame, N m. */
    double force = 0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  };
  /** Left, right. */
  std::array<FootLoad, 2> feet;
};

/** Errors of the sensors. */
struct SensorOptions {
  /** No quantization, noise, bias, range or drift: readings are the true values. */
  bool is_ideal = false;
  /** Steps of the joints' encoders in a turn: the NAO's 12 bit. */
  double encoder_steps = 4096;
  /** Standard deviations of the white noise of each reading and of the constant bias drawn at
   * switch-on, m/s^2 and rad/s. Assumed, as usual for MEMS units of the robot's time. */
  double accelerometer_noise = 0.05;
  double accelerometer_bias = 0.05;
  double gyroscope_noise = 0.005;
  double gyroscope_bias = 0.002;
  /** Ranges, m/s^2 and rad/s: the vendor's 2 g and 500 degrees/s. */
  double accelerometer_range = 2 * kGravity;
  double gyroscope_range = 500 * M_PI / 180;
  /** Rate at which the estimated roll and pitch follow the accelerometer, 1/s. Assumed. */
  double tilt_gain = 0.1;
  /** Foot force sensors: standard deviation as a fraction of the reading, and resolution, N; both
   * assumed. Range, N: the vendor's 25 N a sensor. */
  double foot_force_noise = 0.02;
  double foot_force_step = 0.05;
  double foot_force_range = 25;
  /** Errors of this robot's inertial unit and feet. */
  RobotErrors errors;
};

/** The robot's sensors: readings from true values.
 *
 * reading = clip(quantize(scale * true value + bias + white noise)), as far as each sensor has
 * them: encoders quantize, the inertial unit has bias, noise and range, the foot sensors noise
 * proportional to the force, resolution and range. The estimated orientation is a complementary
 * filter of the unit's own readings (R. Mahony, T. Hamel, J.-M. Pflimlin, Nonlinear Complementary
 * Filters on the Special Orthogonal Group, IEEE TAC 53(5), 2008); its heading drifts. */
class Sensors {
 public:
  Sensors(const RobotModel& model, const SensorOptions& options, uint64_t seed);

  /** Switches on: tick 0, new biases, and a true orientation estimate. @param truth  At rest. */
  void reset(const TrueMotion& truth);
  /** Continues as if it had been switched on so many ticks ago. @param period  Period of a tick, s.
   */
  void set_tick(int64_t tick, double period);
  /** Measures at the end of a control tick. @param period  Its length, s. */
  void update(const TrueMotion& truth, double period);
  /** Measures after the robot was placed somewhere else: joint speeds are 0, and the orientation
   * estimate is true. */
  void jump(const TrueMotion& truth);

  const SensorReadings& readings() const { return readings_; }

 private:
  void measure_joints(const TrueMotion& truth, double period);
  void measure_inertia(const TrueMotion& truth, double period);
  void add_inertial_errors();
  void measure_feet(const TrueMotion& truth);
  double quantized(double position) const;

  SensorOptions options_;
  /** Re-expresses in the inertial unit's axes a vector given in the torso's. */
  Eigen::Matrix3d unit_from_torso_;
  Random random_;
  SensorReadings readings_;
  Eigen::Vector3d accelerometer_bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyroscope_bias_ = Eigen::Vector3d::Zero();
  struct FootSensors {
    /** Indices of the readings. */
    std::vector<int> sensors;
    FootLoad load;
  };
  /** Left, right. */
  std::vector<FootSensors> feet_;
};

}  // namespace nao::sim
