#pragma once

#include "robot_import/repair_log.h"

namespace nao {

/** Makes a joint fixed at an angle, rad, and reports why. */
void hold_joint(TiXmlElement& joint, double angle, const std::string& problem, RepairLog& log);

/** Makes the joints' tree one that the physics can move, after each joint and link by itself is
 * right: mimic joints follow a motor of the same parent body or are held, branches without mass are
 * held, and a link without mass between others gets a little. */
void repair_mechanism(TiXmlElement& robot, RepairLog& log);

}  // namespace nao
