#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "daemons/motion-files/motion_text.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao {

inline std::shared_ptr<const RobotModel> test_model() {
  static const auto model = std::make_shared<const RobotModel>(
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "nao"));
  return model;
}

/** A motion from its keyframes' text. */
inline motion::ActionScript make_motion(const std::string& keyframes,
                                        const std::string& more = "") {
  return parse_motion(
      *test_model(), "actions: [{name: test, " + more + "keyframes: [" + keyframes + "]}]", "test");
}

inline ClosedLoopOptions test_options() {
  ClosedLoopOptions options;
  options.model = test_model();
  options.scene = SceneFile::load(std::filesystem::path(NAO_TEST_DATA) / "scenes" / "empty.yaml");
  return options;
}

inline constexpr const char* kWave =
    "{duration: 0.8, joints: {RShoulderPitch: -0.9, RShoulderRoll: -0.5, RElbowRoll: 1.2}}, "
    "{duration: 0.4, joints: {RElbowRoll: 0.6}}, {duration: 0.4, joints: {RElbowRoll: 1.4}}";

}  // namespace nao
