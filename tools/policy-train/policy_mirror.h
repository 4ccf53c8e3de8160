#pragma once

#include <vector>

#include "policy/policy_manifest.h"
#include "robot_model/robot_model.h"

namespace nao::policy_train {

/** A reflection of numbers at the robot's plane of symmetry: reflected[i] = sign[i] *
 * number[index[i]]. */
struct Reflection {
  std::vector<int> index;
  std::vector<float> sign;
};

/** Of an observation: what the robot's mirror image would observe, half a cycle later. */
Reflection reflect_observation(const RobotModel& model, const PolicyManifest& manifest);
/** Of an action. Joints whose mirror image the policy does not move keep their action. */
Reflection reflect_action(const RobotModel& model, const PolicyManifest& manifest);
/** Of kNumPrivileged numbers, see policy_environment.h. */
Reflection reflect_privileged();

}  // namespace nao::policy_train
