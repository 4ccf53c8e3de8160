#pragma once

#include <string>
#include <vector>

#include "daemons/motion/motion_options.h"
#include "daemons/motion/robot_state.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** State of the TransitionGraph for a robot that stands or crouches on its feet. */
inline constexpr const char* kOnFeet = "on-feet";

/** State of the body in the TransitionGraph: "on-feet"; "belly", "back", "left" or "right" for the
 * side on which it lies; the name of the nearest sitting posture if it is upright and low; or "" if
 * it is none of these, such as a robot that is held in the air.
 *
 * @param lying_tilt  A torso tilted by more than this lies, rad. */
std::string find_body_state(const RobotModel& model, const RobotState& state, double lying_tilt);

/** Whether the torso is tilted by more than an angle, rad. */
bool is_lying(const RobotState& state, double lying_tilt);

/** Whether the torso of an upright robot is higher than that of a robot on its seat. */
bool is_above_seat(const RobotModel& model, const RobotState& state);

/** Whether a state of the body is a sitting posture. */
bool is_sitting(const RobotModel& model, const std::string& body_state);

/** The posture that the robot is in: its joints and its body state are those of the posture.
 * @param position  Measured angles, rad, (num_motors). @return nullptr if it is in none. */
const Posture* find_present_posture(const RobotModel& model, const std::vector<double>& position,
                                    const RobotState& state, const MotionOptions& options);

}  // namespace nao::motion
