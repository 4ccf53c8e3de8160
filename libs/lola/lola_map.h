#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "lola/frame.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Meaning of the values of LoLA's frames for a robot: names, order and signs, from
 * data/robots/NAME/lola.yaml. */
struct LolaMap {
  /** A joint of the frames: its motor in the robot's model, and the factor of its angle, 1 or -1.
   */
  struct JointEntry {
    int motor = -1;
    double sign = 1;
  };
  /** A group of lights: its name in body_state_t, and its key in LolaCommand. */
  struct Light {
    std::string name;
    std::string key;
  };

  /** @throws ModelError  if the file is missing, or does not name every motor once. */
  static LolaMap load(const RobotModel& model);

  std::array<JointEntry, kLolaJoints> joints;
  /** Factors by which LoLA's readings become specific force, m/s^2, and angular velocity, rad/s, in
   * the torso frame. */
  std::array<double, 3> accelerometer_sign{};
  std::array<double, 3> gyroscope_sign{};
  /** For each sensor of LoLA's FSR its index in RobotModel::foot_sensors(). */
  std::array<int, 8> foot_sensors{};
  /** Names of LoLA's Touch and Sonar. */
  std::array<std::string, 14> touch;
  std::array<std::string, 2> sonars;
  /** Index in `touch` of the button that starts and ends the robot. */
  size_t start_button = 0;
  std::vector<Light> lights;
  /** Motor torque that belongs to a current, N m/A. */
  double torque_per_current = 1;
  /** Stiffness of a robot that has sat down, motor order, 0 for most. */
  std::vector<double> seated_stiffness;

  /** Values in LoLA's order from values in motor order. @param is_angle  Multiplies by the joints'
   * signs. */
  std::array<float, kLolaJoints> to_lola(std::span<const double> values, bool is_angle) const;
  /** The inverse. @param values  (num_motors), overwritten. */
  void from_lola(const std::array<float, kLolaJoints>& values, bool is_angle,
                 std::span<double> result) const;
};

/** Shows a color with a group of lights: all eight lights of an eye alike; white lights, which ears
 * and skull have, with the color's greatest part. @param rgb  0 to 1 each. @return false for an
 * unknown key. */
bool set_light(LolaCommand& command, const std::string& key, const std::array<double, 3>& rgb);
/** The mean color of a group of lights; black if the key is not set. */
std::array<double, 3> light_color(const LolaCommand& command, const std::string& key);

}  // namespace nao
