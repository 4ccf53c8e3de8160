#pragma once

#include <filesystem>
#include <vector>

#include "robot_model/robot_model.h"

namespace nao::motion {

/** The NAO from the build tree's files, loaded once. */
inline const RobotModel& nao_model() {
  static const RobotModel model =
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao");
  return model;
}

/** Index of a motor of the NAO. */
inline int nao_motor(const char* joint) {
  return nao_model().find_motor(joint);
}

/** Angles of a posture of the NAO, rad. */
inline const std::vector<double>& nao_posture(const char* name) {
  return nao_model().find_posture(name)->position;
}

}  // namespace nao::motion
