#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "sim/closed_loop/closed_loop.h"

namespace nao::trial {

/** Options of a trial in an empty world with everything random drawn from its seed. */
inline ClosedLoopOptions trial_options() {
  const std::filesystem::path data = NAO_TEST_DATA;
  static const auto model =
      std::make_shared<const RobotModel>(RobotModel::load(data / "robots" / "nao"));
  ClosedLoopOptions options;
  options.model = model;
  options.scene = SceneFile::load(data / "scenes" / "empty.yaml");
  return options;
}

}  // namespace nao::trial
