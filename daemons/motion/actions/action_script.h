#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "daemons/motion/transitions/keyframes.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** An action from a stand that is kept as data: robots/NAME/actions/keeper.yaml, which says what
 * each key means. */
struct ActionScript {
  enum class End { kOnFeet, kGetsUp };

  KeyframeSequence sequence;
  /** Share of the capture point's error that the ankles' torque answers; 0: keyframes alone. */
  double balance_gain = 0;
  End end = End::kOnFeet;

  /** @throws ModelError  naming the line and what is wrong with it. */
  static std::vector<ActionScript> load(const RobotModel& model, const std::filesystem::path& file);
};

}  // namespace nao::motion
