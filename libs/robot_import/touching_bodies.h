#pragma once

#include <string>

#include "robot_model/robot_model.h"

namespace nao {

/** The entry `allowed_contacts` of robot.yaml: pairs of bodies whose collision shapes touch
 * although nothing is wrong, because the shapes are larger than the parts that they stand for.
 * These are the pairs that touch in one of the robot's postures or at nearly all random angles of
 * its joints.
 *
 * Source: the self-collision matrix of MoveIt's setup assistant is found in the same way.
 * @param model  With its postures. @return Empty if there are none. */
std::string make_allowed_contacts_text(const RobotModel& model);

}  // namespace nao
