#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot_import/finding.h"
#include "robot_import/robot_structure.h"
#include "robot_model/robot_model.h"

namespace nao {

/** robot.yaml of a robot by its structure alone: enough to load it. @param urdf  Name of its file.
 */
std::string make_structure_text(const RobotModel& model, const RobotStructure& structure,
                                const std::string& urdf);

/** Links and joints of the soles, "left_sole" and "right_sole", as URDF. */
std::string make_sole_links(const RobotModel& model, const RobotStructure& structure);

/** The other entries of robot.yaml for an imported robot: mirror images, joint groups, heights,
 * references.
 * @param model  With legs and arms. */
std::string make_description_text(const RobotModel& model);

/** Angles of a stance with level soles, bent knees and the center of mass over the soles, rad;
 * nothing if the legs do not reach one. */
std::optional<std::vector<double>> find_ready_stance(const RobotModel& model);

/** postures.yaml: zero; ready, with bent knees and the center of mass over the soles; crouch.
 * @param findings  Receives which postures are beyond the legs' reach.
 * @param foot_distance  Distance of the feet, fraction of that at the angles 0, where the legs have
 *   the joints for it. */
std::string make_postures_text(const RobotModel& model, Findings& findings,
                               double foot_distance = 1);

}  // namespace nao
