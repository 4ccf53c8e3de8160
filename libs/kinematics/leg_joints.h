#pragma once

#include <algorithm>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao {

/** Joints of one leg that are not shared with the other one, from the root to the sole.
 * @param side  0 left, 1 right. */
inline std::vector<int> own_leg_joints(const RobotModel& model, size_t side) {
  const std::vector<int>& others = model.legs()[1 - side].joints;
  std::vector<int> own;
  for (const int joint : model.legs()[side].joints) {
    if (std::find(others.begin(), others.end(), joint) == others.end()) own.push_back(joint);
  }
  return own;
}

}  // namespace nao
