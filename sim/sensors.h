#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "robot_model/robot_model.h"
#include "sim/random.h"

namespace nao::sim {

/** What a robot's sensors say at the end of a control tick, in motor and sensor order. */
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
  /** Torso in W as the inertial unit estimates it. */
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /** N, in the order of RobotModel::foot_sensors(), means over the tick. */
  Eigen::VectorXd foot_force;
};

/** What is true at the end of a control tick, and over it; as SensorReadings otherwise. */
struct TrueMotion {
  Eigen::VectorXd position;
  Eigen::VectorXd torque;
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  struct FootLoad {
    /** Force of the floor along the sole's normal, N, and its moment: force times the place where
     * it acts in the sole's frame, N m. */
    double force = 0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  };
  std::array<FootLoad, 2> feet;
};

/** How good the sensors are. */
struct SensorOptions {
  /** Quantize, disturb and limit; otherwise the truth. */
  bool is_ideal = false;
  /** Steps of the joints' encoders in a turn: 12 bit. */
  double encoder_steps = 4096;
  /** Standard deviation of each reading, and of the constant bias drawn at switch-on. Values of
   * MEMS units of the robot's time, assumed. */
  double accelerometer_noise = 0.05;
  double accelerometer_bias = 0.05;
  double gyroscope_noise = 0.005;
  double gyroscope_bias = 0.002;
  /** Range, m/s^2 and rad/s: the vendor's 2 g and 500 degrees/s. */
  double accelerometer_range = 2 * 9.81;
  double gyroscope_range = 500 * M_PI / 180;
  /** Rate at which the estimate's roll and pitch follow the accelerometer, 1/s. */
  double tilt_gain = 0.1;
  /** Share of a reading, N, and least step, N; assumed. Range: the vendor's 25 N a sensor. */
  double foot_force_noise = 0.02;
  double foot_force_step = 0.05;
  double foot_force_range = 25;
};

/** The robot's sensors: from what is true to what it can measure. */
class Sensors {
 public:
  Sensors(const RobotModel& model, const SensorOptions& options, uint64_t seed);

  /** Switches on: tick 0, fresh biases, an orientation estimate that is true but for the bias.
   * @param truth  At rest. */
  void reset(const TrueMotion& truth);
  /** Measures at the end of a control tick. @param period  Its length, s. */
  void update(const TrueMotion& truth, double period);
  /** Forgets differences over the last tick, after the robot was put somewhere else by hand. */
  void jump(const TrueMotion& truth);

  const SensorReadings& readings() const { return readings_; }

 private:
  void measure_joints(const TrueMotion& truth, double period);
  void measure_inertia(const TrueMotion& truth, double period);
  void measure_feet(const TrueMotion& truth);
  double quantized(double position) const;

  SensorOptions options_;
  Random random_;
  SensorReadings readings_;
  Eigen::Vector3d accelerometer_bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d gyroscope_bias_ = Eigen::Vector3d::Zero();
  /** Sensors of the left and right foot: their places on the sole, m, and indices. */
  struct FootSensor {
    Eigen::Vector2d place;
    int index;
  };
  std::array<std::vector<FootSensor>, 2> feet_;
};

/** Shares in which four sensors, at the corners of a quadrilateral, carry a load at a point. The
 * shares sum to 1 and their centre is the point, or the nearest the quadrilateral has.
 * @param corners  Front left, front right, rear left, rear right; m. */
std::array<double, 4> corner_shares(const std::array<Eigen::Vector2d, 4>& corners,
                                    const Eigen::Vector2d& point);

}  // namespace nao::sim
