#pragma once

#include <cmath>
#include <naolcm/sensor_state_t.hpp>
#include <string>

#include "common/constants.h"

#include "test/daemons/motion/nao_model.h"

namespace nao::motion {

/** A complete message of a robot that stands in a posture. @param period  Control period, s. */
inline naolcm::sensor_state_t sensor_message(const std::string& posture, int64_t tick,
                                             double period = 0.01) {
  naolcm::sensor_state_t message{};
  message.utime = tick * std::lround(period * 1e6);
  message.tick = tick;
  message.period = period;
  const auto& position = nao_model().find_posture(posture)->position;
  message.num_joints = nao_model().num_motors();
  message.joint_names = nao_model().motor_names();
  for (int motor = 0; motor < nao_model().num_motors(); ++motor) {
    message.joint_position.push_back(position[motor]);
    message.joint_velocity.push_back(0);
    message.joint_torque.push_back(0);
    message.joint_target_position.push_back(position[motor]);
    message.joint_stiffness.push_back(1);
  }
  message.accelerometer_torso[2] = kGravity;
  message.orientation_torso_in_world[0] = 1;
  message.num_foot_sensors = static_cast<int>(nao_model().foot_sensors().size());
  for (int link : nao_model().foot_sensors()) {
    message.foot_sensor_names.push_back(nao_model().links()[link].name);
    message.foot_force.push_back(6.5);
  }
  return message;
}

}  // namespace nao::motion
