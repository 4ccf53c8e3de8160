#pragma once

#include <string>
#include <vector>

#include "daemons/motion/robot_state.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Where the body is, as a state of the TransitionGraph: "on-feet", "belly", "back", "left",
 * "right", the name of the sitting posture that is nearest if it is upright and low, or "" if it is
 * nothing of these, such as held in the air.
 *
 * @param lying_tilt  Torso tilted more than this lies, rad. */
std::string find_body_state(const RobotModel& model, const RobotState& state, double lying_tilt);

}  // namespace nao::motion
