#pragma once

#include <naolcm/body_state_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <naolcm/world_command_t.hpp>
#include <naolcm/world_truth_t.hpp>

#include "sim/joint_command.h"
#include "sim/sim_core.h"
#include "sim/world_command.h"

namespace nao::sim {

/** Joints, positions and stiffness; other fields are not simulated. */
JointCommand to_core(const naolcm::joint_command_t& message);
WorldCommand to_core(const naolcm::world_command_t& message);

/** Measurements of a robot, and the targets that its servos hold. */
naolcm::sensor_state_t sensor_state_of(const World& world, int robot);

/** Lights of a robot on the bus; the other parts of a body are not simulated: no motors, touch
 * sensors, sonars or battery. */
naolcm::body_state_t body_state_of(const SimCore& core, int robot);

/** The true state of the world and its robots. */
naolcm::world_truth_t world_truth_of(const SimCore& core, double real_time_factor);

}  // namespace nao::sim
