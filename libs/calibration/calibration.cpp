#include "calibration/calibration.h"

#include <array>
#include <cstdio>

#include "common/constants.h"
#include "common/error.h"
#include "common/yaml_entry.h"

namespace nao {
namespace {

// Greatest differences that a file may state. Chosen: a robot beyond them is broken, and the file
// was more likely written in degrees.
constexpr double kMaxAngle = 0.35;  // rad
constexpr double kMaxRate = 0.35;   // rad/s
constexpr double kMinScale = 0.2;
constexpr double kMaxScale = 5;

// Written so that NaN fails; the error names the entry with file and line.
double number_within(const YamlEntry& entry, double least, double most) {
  const double number = entry.number();
  if (number >= least && number <= most) return number;
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "is %g, outside [%g, %g]", number, least, most);
  entry.fail(text.data());
}

Eigen::Vector3d vector_within(const YamlEntry& entry, double least, double most) {
  Eigen::Vector3d vector;
  const std::vector<YamlEntry> items = entry.items();
  if (items.size() != 3) entry.fail("must be a list of 3 numbers");
  for (int k = 0; k < 3; ++k) vector[k] = number_within(items[k], least, most);
  return vector;
}

int find_foot_sensor(const RobotModel& model, const std::string& name) {
  for (size_t i = 0; i < model.foot_sensors().size(); ++i) {
    if (model.links()[model.foot_sensors()[i]].name == name) return static_cast<int>(i);
  }
  return -1;
}

// Each part is optional and stays at its neutral value: 0, or 1 for scales.
Calibration read(const RobotModel& model, const YamlEntry& root) {
  root.allow_only({"date", "joint_zero", "imu_mount", "gyroscope_scale", "gyroscope_offset",
                   "foot_sensor_scale"});
  Calibration result(model);
  if (root.has("date")) result.date = root.at("date").text();
  if (root.has("joint_zero")) {
    for (const auto& [name, entry] : root.at("joint_zero").entries()) {
      const int motor = model.find_motor(name);
      if (motor < 0) entry.fail("is not a joint with a motor of " + model.name());
      result.joint_zero[motor] = number_within(entry, -kMaxAngle, kMaxAngle);
    }
  }
  if (root.has("imu_mount")) {
    result.imu_mount = vector_within(root.at("imu_mount"), -kMaxAngle, kMaxAngle);
  }
  if (root.has("gyroscope_scale")) {
    result.gyroscope_scale = vector_within(root.at("gyroscope_scale"), kMinScale, kMaxScale);
  }
  if (root.has("gyroscope_offset")) {
    result.gyroscope_offset = vector_within(root.at("gyroscope_offset"), -kMaxRate, kMaxRate);
  }
  if (root.has("foot_sensor_scale")) {
    for (const auto& [name, entry] : root.at("foot_sensor_scale").entries()) {
      const int sensor = find_foot_sensor(model, name);
      if (sensor < 0) entry.fail("is not a foot force sensor of " + model.name());
      // 0 is outside the range and means a dead sensor.
      const bool is_dead = entry.number() == 0;
      result.foot_sensor_scale[sensor] = is_dead ? 0 : number_within(entry, kMinScale, kMaxScale);
    }
  }
  return result;
}

std::string format(const char* pattern, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string list_of(const Eigen::Vector3d& vector) {
  return "[" + format("%.5f", vector.x()) + ", " + format("%.5f", vector.y()) + ", " +
         format("%.5f", vector.z()) + "]";
}

}  // namespace

Calibration::Calibration(const RobotModel& model)
    : joint_zero(model.num_motors(), 0.0), foot_sensor_scale(model.foot_sensors().size(), 1.0) {}

Calibration Calibration::load(const RobotModel& model, const std::filesystem::path& file) {
  return read(model, YamlEntry::load<ConfigError>(file));
}

Calibration Calibration::parse(const RobotModel& model, const std::string& text,
                               const std::string& name) {
  return read(model, YamlEntry::parse<ConfigError>(text, name));
}

// Writes the form that read() accepts; angles are rounded to 0.00001 rad, far below an encoder's
// step.
std::string Calibration::to_yaml(const RobotModel& model) const {
  std::string text =
      "# How one " + model.name() +
      " differs from its model: written by nao calibrate, read by nao-motion --calibration.\n";
  if (!date.empty()) text += "date: \"" + date + "\"\n";
  text += "# What the encoders read at the joints' angle 0, rad. Joints not listed: 0.\n";
  text += "joint_zero:";
  bool has_zero = false;
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    if (joint_zero[motor] == 0) continue;
    has_zero = true;
    text += "\n  " + model.motor_names()[motor] + ": " + format("%.5f", joint_zero[motor]);
    text += "  # " + format("%.2f", joint_zero[motor] / kDegree) + " deg";
  }
  text += has_zero ? "\n" : " {}\n";
  text +=
      "# Rotation vector of the inertial unit's mounting in the torso (x ahead, y left), rad.\n";
  text += "imu_mount: " + list_of(imu_mount) + "\n";
  text += "# Axes of the gyroscope: reading = scale * true value + offset; 1 and rad/s.\n";
  text += "gyroscope_scale: " + list_of(gyroscope_scale) + "\n";
  text += "gyroscope_offset: " + list_of(gyroscope_offset) + "\n";
  text += "# Reading per force of each force sensor of the feet; 0: the sensor is dead.\n";
  text += "foot_sensor_scale:";
  for (size_t i = 0; i < foot_sensor_scale.size(); ++i) {
    text += "\n  " + model.links()[model.foot_sensors()[i]].name + ": " +
            format("%.3f", foot_sensor_scale[i]);
  }
  text += foot_sensor_scale.empty() ? " {}\n" : "\n";
  return text;
}

}  // namespace nao
