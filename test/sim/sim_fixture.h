#pragma once

#include <memory>

#include "common/data_path.h"
#include "robot_model/robot_model.h"

namespace nao::sim {

/** The NAO, loaded once for all tests of a program. */
inline std::shared_ptr<const RobotModel> nao_model() {
  static const auto model =
      std::make_shared<const RobotModel>(RobotModel::load(data_path() / "robots/nao"));
  return model;
}

}  // namespace nao::sim
