#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "daemons/motion/actions/action_script.h"
#include "messages/motion_file.h"
#include "messages/reason.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Bounds of a taught motion. Chosen: far more than a person teaches, and few enough that every
 * motion can be checked. */
struct TaughtMotionBounds {
  static constexpr int kMaxKeyframes = 200;
  static constexpr int kMaxRepetitions = 100;
  /** s. */
  static constexpr double kMinDuration = 0.1;
  static constexpr double kMaxDuration = 60;
  /** Greatest duration of all keyframes, each played once, s. */
  static constexpr double kMaxTotal = 120;
};

/** A fault of a taught motion. */
struct MotionFault {
  /** Index of the keyframe with the fault; -1: no particular one. */
  int keyframe = -1;
  Reason reason;
};

/** Checks what does not depend on the robot: number of keyframes and repetitions, times. */
std::optional<MotionFault> find_form_fault(const ActionScript& script);

/** Checks a motion with named joints and converts it. Its joints' limits and speeds are not checked
 * here. */
std::variant<ActionScript, MotionFault> to_script(const RobotModel& model,
                                                  const NamedMotion& motion);

/** The same motion with named joints: those that any keyframe moves. */
NamedMotion to_named(const RobotModel& model, const ActionScript& script);

/** Start posture of a motion that names none: the upright or sitting posture whose legs are nearest
 * to the first keyframe, or the robot's ready posture if no keyframe moves a leg. */
std::string find_start_posture(const RobotModel& model, const std::vector<Keyframe>& keyframes);

/** Whether a motion starts on the feet, and so must not fall. */
bool starts_on_feet(const RobotModel& model, const ActionScript& script);

}  // namespace nao::motion
