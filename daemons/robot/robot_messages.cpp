#include "daemons/robot/robot_messages.h"

#include "common/error.h"
#include "messages/named_joints.h"
#include "messages/reason.h"

namespace nao::robot {

// The constant parts of the messages are filled in once.
RobotMessages::RobotMessages(const RobotModel& model, const LolaMap& map) {
  const auto num_motors = static_cast<size_t>(model.num_motors());
  naolcm::sensor_state_t& sensors = sensor_state_;
  sensors.period = kLolaPeriod;
  sensors.num_joints = model.num_motors();
  sensors.joint_names = model.motor_names();
  // LoLA has no torques: 0.
  sensors.joint_torque.assign(num_motors, 0);
  sensors.joint_stiffness.assign(num_motors, 0);
  for (const int link : model.foot_sensors()) {
    sensors.foot_sensor_names.push_back(model.links()[static_cast<size_t>(link)].name);
  }
  sensors.num_foot_sensors = static_cast<int>(sensors.foot_sensor_names.size());

  naolcm::body_state_t& body = body_state_;
  body.num_joints = model.num_motors();
  body.joint_names = model.motor_names();
  body.joint_status.assign(num_motors, 0);
  body.touch_names.assign(map.touch.begin(), map.touch.end());
  body.num_touch = static_cast<int>(map.touch.size());
  body.is_touched.assign(map.touch.size(), 0);
  body.sonar_names.assign(map.sonars.begin(), map.sonars.end());
  body.num_sonars = static_cast<int>(map.sonars.size());
  for (const LolaMap::Light& light : map.lights) body.light_names.push_back(light.name);
  body.num_lights = static_cast<int>(map.lights.size());
  body.light_rgb.assign(map.lights.size(), std::vector<double>(3, 0));
}

const naolcm::sensor_state_t& RobotMessages::sensor_state(const RobotCore& core, int64_t utime) {
  const Measurement& measured = core.measurement();
  naolcm::sensor_state_t& message = sensor_state_;
  message.utime = utime;
  message.tick = core.tick();
  message.joint_position = measured.position;
  message.joint_velocity = measured.velocity;
  message.joint_target_position = core.targets().position;
  for (size_t i = 0; i < message.joint_stiffness.size(); ++i) {
    message.joint_stiffness[i] = core.commanded_stiffness(static_cast<int>(i));
  }
  for (int i = 0; i < 3; ++i) {
    message.accelerometer_torso[i] = measured.accelerometer[i];
    message.gyroscope_torso[i] = measured.gyroscope[i];
  }
  message.is_accelerometer_new = measured.is_accelerometer_new ? 1 : 0;
  message.is_gyroscope_new = measured.is_gyroscope_new ? 1 : 0;
  message.orientation_torso_in_world[0] = measured.orientation.w();
  message.orientation_torso_in_world[1] = measured.orientation.x();
  message.orientation_torso_in_world[2] = measured.orientation.y();
  message.orientation_torso_in_world[3] = measured.orientation.z();
  message.foot_force = measured.foot_force;
  return message;
}

const naolcm::body_state_t& RobotMessages::body_state(const RobotCore& core, int64_t utime) {
  const Measurement& measured = core.measurement();
  naolcm::body_state_t& message = body_state_;
  message.utime = utime;
  message.battery_charge = measured.battery_charge;
  message.battery_current = measured.battery_current;
  message.battery_temperature = measured.battery_temperature;
  message.joint_temperature = measured.temperature;
  message.joint_current = measured.current;
  for (size_t i = 0; i < message.joint_status.size(); ++i) {
    // HealthMonitor's conditions have the order of JOINT_STATUS_*.
    message.joint_status[i] = static_cast<int8_t>(core.health().motor(static_cast<int>(i)));
  }
  for (size_t i = 0; i < message.is_touched.size(); ++i) {
    message.is_touched[i] = measured.is_touched[i] ? 1 : 0;
  }
  message.sonar_range.assign(measured.sonar_range.begin(), measured.sonar_range.end());
  for (size_t i = 0; i < message.light_rgb.size(); ++i) {
    const LightColor& color = core.lights().shown()[i];
    message.light_rgb[i].assign(color.begin(), color.end());
  }
  message.warning_codes = core.health().warnings();
  message.num_warnings = static_cast<int>(message.warning_codes.size());
  return message;
}

// Errors leave the command as it is; the bus counts the message as dropped.
void merge(const naolcm::joint_command_t& message, const std::vector<std::string>& motor_names,
           Targets& targets) {
  const auto fault =
      read_named_joints(motor_names, message.joint_names,
                        {{"position", message.joint_position, targets.position},
                         {"stiffness", message.joint_stiffness, targets.stiffness, 0, 1}},
                        JointCoverage::kSubset);
  if (fault) throw MessageError(to_sentence(*fault));
}

}  // namespace nao::robot
