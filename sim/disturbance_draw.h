#pragma once

#include <cstdint>

#include "robot_model/robot_model.h"
#include "sim/disturbances.h"
#include "sim/world_options.h"

namespace nao::sim {

/** Draws what disturbs the world: slope and bumps of the floor, stiffness of its contacts, length
 * of a control tick.
 * @param options  The other options, and what is not disturbed; its step must divide the tick. */
void draw_world(const DisturbanceSet& set, uint64_t seed, WorldOptions& options);

/** Draws what disturbs one robot: joints, servos, sensors, masses, torques, friction, latency,
 * losses.
 *
 * Each disturbance has its own stream of random numbers: it does not depend on the robot's other
 * disturbances. Without any disturbance (DisturbanceSet::is_none()) sensors are ideal and motors
 * follow at once.
 * @param index  Index of the robot in its world: robots differ. @param world  As drawn before.
 * @param options  The other options, and what is not disturbed. */
void draw_robot(const DisturbanceSet& set, uint64_t seed, int index, const RobotModel& model,
                const WorldOptions& world, RobotOptions& options);

/** Greatest number of values that draw_world() and draw_robot() take from Random(seed) itself;
 * callers that draw more from the same seed skip them. */
inline constexpr int kNumSharedDraws = 3;

}  // namespace nao::sim
