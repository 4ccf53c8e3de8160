#pragma once

#include <memory>
#include <string>

#include "test/libs/policy/manifests.h"
#include "tools/policy-train/policy_environment.h"

namespace nao::policy_train {

/** A walk of the T1's legs, with one phase. */
inline const char* const kLegs = R"(kind: walk
network: policy.onnx
rate: 50
observations:
  - {quantity: angular_velocity}
  - {quantity: projected_gravity}
  - {quantity: velocity_command}
  - {quantity: joint_position}
  - {quantity: joint_velocity, scale: 0.1}
  - {quantity: last_action}
  - {quantity: phase_sine}
phase: {frequency: 1.5}
action: {scale: 0.25}
joints:
  - {name: Left_Hip_Pitch, default: -0.3}
  - {name: Left_Hip_Roll}
  - {name: Left_Knee_Pitch, default: 0.6}
  - {name: Left_Ankle_Pitch, default: -0.3}
  - {name: Right_Hip_Pitch, default: -0.3}
  - {name: Right_Hip_Roll}
  - {name: Right_Knee_Pitch, default: 0.6}
  - {name: Right_Ankle_Pitch, default: -0.3}
command: {vx: [-0.2, 0.8], vy: [-0.1, 0.1], wz: [-0.4, 0.4]}
)";

inline EnvironmentOptions options_of(const std::string& manifest) {
  EnvironmentOptions options;
  options.model = std::make_shared<RobotModel>(t1_model());
  options.manifest = std::make_shared<PolicyManifest>(parse_manifest(manifest));
  options.disturbances = std::make_shared<sim::DisturbanceSet>();
  options.scene = SceneFile::find("empty");
  return options;
}

}  // namespace nao::policy_train
