#pragma once

#include <functional>

#include "robot_model/robot_model.h"

namespace nao::sim {

class World;

/** @param spread   Greatest difference from the ready posture, rad, within the joints' ranges.
 * @param uniform  Draws a number between two others. */
Posture draw_posture(const RobotModel& model, double spread,
                     const std::function<double(double, double)>& uniform);

/** Lays a robot down at the origin, with joint angles up to 0.5 rad from its ready posture.
 * @param side     Rotation about its long axis, rad: 0 on the belly, pi on the back.
 * @param uniform  Draws a number between two others. @return Its angles. */
Posture lay_down(World& world, int robot, double side,
                 const std::function<double(double, double)>& uniform);

}  // namespace nao::sim
