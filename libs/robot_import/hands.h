#pragma once

#include <string>

#include "robot_import/finding.h"
#include "robot_import/robot_structure.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Lets the fingers of each hand follow one motor, so that people open and close it by one slider.
 * A hand is where an arm branches into three fingers or more, or into two that one motor moves
 * already.
 * @param text  The URDF that the model was read from. @param structure  Its hands become the links
 * that carry the fingers. @param file  The URDF's name. @param findings  Receives what follows.
 * @return The URDF with the mimic joints. */
std::string with_hands_of_one_motor(const std::string& text, const RobotModel& model,
                                    const std::string& file, RobotStructure& structure,
                                    Findings& findings);

}  // namespace nao
