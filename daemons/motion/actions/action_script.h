#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "daemons/motion/transitions/keyframes.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** An action that is stored as data: one of the robot's own, from a stand
 * (data/robots/NAME/actions/keeper.yaml says what each key means); or one that people taught
 * (TaughtMotionText). */
struct ActionScript {
  /** kHolds: taught motions only; the robot holds the last keyframe. */
  enum class End { kOnFeet, kGetsUp, kHolds };

  KeyframeSequence sequence;
  /** Fraction of the capture point's error that the ankles' torque corrects; 0: keyframes alone. */
  double balance_gain = 0;
  End end = End::kOnFeet;
  /** Taught motions only: the posture that the motion starts from, and how often its keyframes are
   * played. */
  std::string start;
  int num_repetitions = 1;

  /** @throws ModelError  naming the line and what is wrong with it. */
  static std::vector<ActionScript> load(const RobotModel& model, const std::filesystem::path& file);
};

}  // namespace nao::motion
