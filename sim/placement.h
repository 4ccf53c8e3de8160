#pragma once

#include <Eigen/Geometry>

#include "robot_model/robot_model.h"
#include "sim/collision_model.h"
#include "sim/floor.h"
#include "sim/tree.h"
#include "sim/tree_dynamics.h"

namespace nao::sim {

/** Orientation of the torso in W in which a posture rests on a level floor, facing along x: soles
 * level when it stands or crouches, on back or belly when it lies, and at the lowest center of mass
 * when it sits. @param posture  nullptr: upright. */
Eigen::Quaterniond resting_orientation(const RobotModel& model, const Tree& tree,
                                       const CollisionModel& collisions, const Posture* posture);

/** Least height of a robot's collision shapes over the floor, m; 0 for a robot without shapes. */
double lowest_point(const CollisionModel& collisions, const TreeDynamics& dynamics,
                    const Floor& floor);

}  // namespace nao::sim
