#pragma once

#include <string>

#include "daemons/motion/actions/action_script.h"
#include "robot_model/robot_model.h"

namespace nao {

/** Greatest size of the text of a motion, bytes: 200 keyframes of all joints take a third. */
inline constexpr size_t kMaxMotionTextBytes = 262144;

/** Reads a taught motion: a file of the robot's own actions (data/robots/NAME/actions/keeper.yaml
 * says what each key means) with one entry, in which
 *
 *     start         posture that it starts from; left out: find_start_posture()
 *     repetitions   how often the keyframes are played; left out: once
 *     end           holds, or left out
 *     balance_gain  0, or left out
 *
 * Joint limits and speeds are not checked here, nor the number of keyframes.
 * @param source  Where the text is from, for errors.
 * @throws ModelError  naming the line and what is wrong with it. */
motion::ActionScript parse_motion(const RobotModel& model, const std::string& text,
                                  const std::string& source);

/** The text of a file that parse_motion() reads as the same motion, numbers rounded to six digits.
 */
std::string to_yaml(const RobotModel& model, const motion::ActionScript& script);

}  // namespace nao
