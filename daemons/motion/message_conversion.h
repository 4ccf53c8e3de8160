#pragma once

#include <naolcm/action_command_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/keyframe_motion_t.hpp>
#include <naolcm/motion_state_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/policy_state_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/vision_state_t.hpp>
#include <naolcm/walk_command_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "daemons/motion/joint_targets.h"
#include "daemons/motion/motion_core.h"
#include "daemons/motion/motion_state.h"
#include "daemons/motion/robot_state.h"
#include "daemons/motion/sensors.h"
#include "messages/command.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

// Conversions between the messages of the bus and the core's types. A wrong number in a command is
// no error here: the core refuses the command with a reason.

/** @throws MessageError  naming the joint or sensor that is missing, unknown or listed twice, or
 * the quantity that is not finite or out of its range. Such a message must not reach the core. */
Sensors to_sensors(const RobotModel& model, const naolcm::sensor_state_t& message);

Command to_command(const naolcm::walk_command_t& message);
Command to_command(const naolcm::move_to_command_t& message);
Command to_command(const naolcm::posture_command_t& message);
Command to_command(const naolcm::joint_change_command_t& message);
Command to_command(const naolcm::action_command_t& message);
Command to_command(const naolcm::stop_command_t& message);

/** @throws MessageError  if it is not a motion of this robot: it must not reach the core. */
TaughtChange to_taught(const RobotModel& model, const naolcm::keyframe_motion_t& message);

/** @return Nothing if nao-vision knows no ball. @throws MessageError  if its position is not
 * finite. */
std::optional<SeenBall> to_seen_ball(const naolcm::vision_state_t& message);

/** @param names  Names of all motors' joints, in motor order. */
naolcm::joint_command_t to_message(const JointTargets& targets, const RobotState& state,
                                   const std::vector<std::string>& names);
naolcm::robot_state_t to_message(const RobotState& state, const std::vector<std::string>& names);
naolcm::motion_state_t to_message(const MotionState& state);
naolcm::policy_state_t to_message(const PolicyRecord& record, int64_t utime);

}  // namespace nao::motion
