#include "policy/policy_runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace nao {
namespace {

// Steps one after the other in which a target may move faster than the joint's motor. Chosen: noise
// of a trained policy exceeds it in one or two. A robot on the ground cannot fall, and gets up by
// targets that its joints follow as fast as their motors allow: half a second.
constexpr int kMaxFastSteps = 5;
constexpr int kMaxFastGetUpSteps = 25;
// Distance of a target from the default angle, rad, beyond which the output is not an angle: a
// turn.
constexpr double kMaxDistance = 2 * M_PI;
// Processor time of an inference after which the policy ends at once, s, and inferences one after
// the other that may take longer than a step. Chosen: a walking robot that holds its targets for
// longer falls.
constexpr double kMaxInferenceTime = 0.1;
constexpr int kMaxSlowInferences = 3;
// A sum of control periods may be this much below the policy's period by rounding, s.
constexpr double kRounding = 1e-6;

}  // namespace

PolicyRunner::PolicyRunner(const RobotModel& model, const PolicyManifest& manifest,
                           PolicyNetwork& network)
    : model_(&model), manifest_(&manifest), network_(&network), builder_(manifest) {
  start();
}

void PolicyRunner::start(double lead) {
  builder_.reset(lead);
  action_.assign(manifest_->joints.size(), 0.0F);
  targets_.clear();
  for (const PolicyJoint& joint : manifest_->joints) targets_.push_back(joint.default_angle);
  last_targets_ = targets_;
  num_fast_steps_.assign(targets_.size(), 0);
  num_slow_inferences_ = 0;
  inference_time_ = 0;
  time_left_ = 0;
  num_steps_ = 0;
}

std::optional<std::string> PolicyRunner::step(const PolicyInput& input, double dt) {
  time_left_ -= dt;
  if (num_steps_ > 0 && time_left_ > kRounding) return std::nullopt;
  // After a gap longer than a step, one step is enough.
  time_left_ = std::max(0.0, manifest_->period + (num_steps_ > 0 ? time_left_ : 0));
  observation_ = builder_.build(input, action_);
  std::vector<float> action;
  inference_time_ = network_->run(observation_, action);
  ++num_steps_;
  action_ = std::move(action);
  if (auto fault = find_fault()) return fault;
  last_targets_ = targets_;
  return std::nullopt;
}

std::optional<std::string> PolicyRunner::find_fault() {
  const bool is_get_up = manifest_->kind == PolicyManifest::Kind::kGetUp;
  if (action_.size() != manifest_->joints.size()) {
    return fmt::format("{} outputs for {} joints", action_.size(), manifest_->joints.size());
  }
  for (size_t i = 0; i < action_.size(); ++i) {
    const PolicyJoint& joint = manifest_->joints[i];
    const std::string& name = model_->motor_names()[static_cast<size_t>(joint.motor)];
    if (!std::isfinite(action_[i])) {
      return fmt::format("output {} of {}, for {}, is not finite", i + 1, action_.size(), name);
    }
    const auto clip = static_cast<float>(manifest_->action_clip);
    action_[i] = std::clamp(action_[i], -clip, clip);
    const double change = joint.scale * static_cast<double>(action_[i]);
    if (std::abs(change) > kMaxDistance) {
      return fmt::format("output {} of {} turns {} by {:.3g} rad", i + 1, action_.size(), name,
                         change);
    }
    targets_[i] = joint.default_angle + change;
    const double speed = std::abs(targets_[i] - last_targets_[i]) / manifest_->period;
    const double limit = model_->motor_joint(joint.motor).max_velocity;
    num_fast_steps_[i] = num_steps_ > 1 && speed > limit ? num_fast_steps_[i] + 1 : 0;
    if (num_fast_steps_[i] > (is_get_up ? kMaxFastGetUpSteps : kMaxFastSteps)) {
      return fmt::format("it moves {} at {:.1f} rad/s for {} steps; its motor turns at {:.1f}",
                         name, speed, num_fast_steps_[i], limit);
    }
  }
  num_slow_inferences_ = inference_time_ > manifest_->period ? num_slow_inferences_ + 1 : 0;
  if (inference_time_ > kMaxInferenceTime || num_slow_inferences_ > kMaxSlowInferences) {
    return fmt::format("an inference took {:.0f} ms; a step lasts {:.0f} ms", 1e3 * inference_time_,
                       1e3 * manifest_->period);
  }
  return std::nullopt;
}

}  // namespace nao
