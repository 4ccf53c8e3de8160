#include "tools/policy-train/policy_mirror.h"

#include <algorithm>
#include <cmath>

namespace nao::policy_train {
namespace {

/** Of joints, by the numbers of their motors. */
Reflection reflect_motors(const RobotModel& model, const std::vector<int>& motors) {
  Reflection result;
  for (size_t i = 0; i < motors.size(); ++i) {
    const MirrorMotor& mirror = model.symmetry().mirrors[static_cast<size_t>(motors[i])];
    const auto other = std::find(motors.begin(), motors.end(), mirror.motor);
    const bool is_found = other != motors.end();
    result.index.push_back(is_found ? static_cast<int>(other - motors.begin())
                                    : static_cast<int>(i));
    result.sign.push_back(is_found ? static_cast<float>(mirror.sign) : 1);
  }
  return result;
}

std::vector<int> motors_of(const PolicyManifest& manifest) {
  std::vector<int> motors;
  for (const PolicyJoint& joint : manifest.joints) motors.push_back(joint.motor);
  return motors;
}

Reflection with_signs(const std::vector<float>& signs) {
  Reflection result;
  for (size_t i = 0; i < signs.size(); ++i) result.index.push_back(static_cast<int>(i));
  result.sign = signs;
  return result;
}

/** Half a cycle later, the wave of a foot is that of the foot whose lead differs by half a cycle,
 * or the negative one. */
Reflection reflect_phases(const PolicyTerm& term) {
  Reflection result;
  for (size_t i = 0; i < term.values.size(); ++i) {
    const auto is_opposite = [&](double lead) {
      return std::abs(std::remainder(lead - term.values[i] - 0.5, 1.0)) < 1e-6;
    };
    const auto other = std::find_if(term.values.begin(), term.values.end(), is_opposite);
    const bool is_found = other != term.values.end();
    result.index.push_back(
        static_cast<int>(is_found ? other - term.values.begin() : static_cast<long>(i)));
    result.sign.push_back(is_found ? 1.0F : -1.0F);
  }
  return result;
}

Reflection reflect_term(const RobotModel& model, const PolicyManifest& manifest,
                        const PolicyTerm& term) {
  switch (term.quantity) {
    case PolicyQuantity::kAngularVelocity:
      return with_signs({-1, 1, -1});
    case PolicyQuantity::kLinearVelocity:
    case PolicyQuantity::kProjectedGravity:
      return with_signs({1, -1, 1});
    case PolicyQuantity::kVelocityCommand:
      return with_signs({1, -1, -1});
    case PolicyQuantity::kLinearCommand:
      return with_signs({1, -1});
    case PolicyQuantity::kTurnCommand:
      return with_signs({-1});
    case PolicyQuantity::kPhaseSine:
    case PolicyQuantity::kPhaseCosine:
      return reflect_phases(term);
    case PolicyQuantity::kJointPosition:
    case PolicyQuantity::kJointVelocity:
      return reflect_motors(model, manifest.observed_motors);
    case PolicyQuantity::kLastAction:
      return reflect_action(model, manifest);
    case PolicyQuantity::kConstant:
      break;
  }
  return with_signs(std::vector<float>(static_cast<size_t>(term.size), 1));
}

}  // namespace

Reflection reflect_action(const RobotModel& model, const PolicyManifest& manifest) {
  return reflect_motors(model, motors_of(manifest));
}

Reflection reflect_privileged() {
  Reflection result = with_signs({1, -1, 1, -1, 1, -1, 1, 1, 1});
  std::swap(result.index[7], result.index[8]);
  return result;
}

Reflection reflect_observation(const RobotModel& model, const PolicyManifest& manifest) {
  Reflection result;
  const auto append = [&](const PolicyTerm& term) {
    const Reflection one = reflect_term(model, manifest, term);
    const auto first = static_cast<int>(result.index.size());
    for (const int index : one.index) result.index.push_back(first + index);
    result.sign.insert(result.sign.end(), one.sign.begin(), one.sign.end());
  };
  if (manifest.is_by_step) {
    for (int k = 0; k < manifest.terms.front().num_steps; ++k) {
      for (const PolicyTerm& term : manifest.terms) append(term);
    }
  } else {
    for (const PolicyTerm& term : manifest.terms) {
      for (int k = 0; k < term.num_steps; ++k) append(term);
    }
  }
  return result;
}

}  // namespace nao::policy_train
