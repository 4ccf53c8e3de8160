#pragma once

#include <filesystem>

#include "robot_model/robot_model.h"

namespace nao::motion {

/** The NAO from the build tree's files, loaded once. */
inline const RobotModel& nao_model() {
  static const RobotModel model =
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao");
  return model;
}

}  // namespace nao::motion
