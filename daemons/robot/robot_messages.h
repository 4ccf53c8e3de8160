#pragma once

#include <cstdint>
#include <naolcm/body_state_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <string>
#include <vector>

#include "daemons/robot/robot_core.h"
#include "daemons/robot/targets.h"
#include "robot_model/robot_model.h"

namespace nao::robot {

/** Makes sensor_state_t and body_state_t. Names are written once; later calls only change numbers.
 */
class RobotMessages {
 public:
  /** @param model  Must outlive this. */
  RobotMessages(const RobotModel& model, const LolaMap& map);

  /** Velocities are differences of the angles; torques are 0, since LoLA sends none. */
  const naolcm::sensor_state_t& sensor_state(const RobotCore& core, int64_t utime);
  const naolcm::body_state_t& body_state(const RobotCore& core, int64_t utime);

 private:
  naolcm::sensor_state_t sensor_state_{};
  naolcm::body_state_t body_state_{};
};

/** Merges a joint command into targets; joints that it does not name keep theirs.
 * @throws MessageError  naming the joint and what is wrong with it; then nothing changes. */
void merge(const naolcm::joint_command_t& message, const std::vector<std::string>& motor_names,
           Targets& targets);

}  // namespace nao::robot
