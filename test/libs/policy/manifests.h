#pragma once

#include <filesystem>
#include <string>

#include "policy/policy_manifest.h"

namespace nao {

inline const RobotModel& t1_model() {
  static const RobotModel model =
      RobotModel::load(std::filesystem::path(NAO_TEST_DATA) / "robots" / "t1");
  return model;
}

/** A policy of two joints with 8 observations. */
inline const char* const kSmallManifest = R"(kind: walk
network: policy.onnx
rate: 50
observations:
  - {quantity: velocity_command, scale: [2, 2, 0.25]}
  - {quantity: joint_position}
  - {quantity: joint_velocity, scale: 0.05}
  - {quantity: turn_command}
action: {scale: 0.5, clip: 2}
joints:
  - {name: Left_Knee_Pitch, default: 0.4, stiffness: 200, damping: 5}
  - {name: Right_Knee_Pitch, default: 0.4, scale: 0.25}
command: {vx: [-0.2, 0.8], vy: [-0.1, 0.1], wz: [-0.4, 0.4]}
)";

inline PolicyManifest parse_manifest(const std::string& text) {
  return PolicyManifest::parse(t1_model(), text, "policy.yaml");
}

/** A text with one part replaced by another. */
inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
  return text.replace(text.find(part), part.size(), by);
}

}  // namespace nao
