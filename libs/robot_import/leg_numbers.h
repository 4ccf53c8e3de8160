#pragma once

#include <string>

#include "robot_import/finding.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Replaces limits of the legs' joints with which a robot could not carry itself: efforts unlike
 * those of the mirror image, efforts of motors before their gears, ranges that exclude every stance
 * with level soles and bent knees.
 * @param text  The URDF that the model was read from. @param model  With legs.
 * @param file  The URDF's name. @param findings  Receives what was replaced.
 * @return The URDF with the replaced numbers. */
std::string with_plausible_legs(const std::string& text, const RobotModel& model,
                                const std::string& file, Findings& findings);

}  // namespace nao
