#pragma once

#include <string>

#include "robot_import/finding.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Replaces efforts, velocities and inertias of a URDF that this robot's mass and size exclude:
 * placeholders, units of another kind, faults of an export.
 * @param text  The URDF that the model was read from. @param leg  Height of its legs, m.
 * @param file  Its name. @param findings  Receives what was replaced.
 * @return The URDF with the replaced numbers. */
std::string with_plausible_numbers(const std::string& text, const RobotModel& model, double leg,
                                   const std::string& file, Findings& findings);

}  // namespace nao
