#include "policy/observation_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao {
namespace {

using Rest = PolicyManifest::PhaseAtRest;

/** A phase of the gait, cycles, as its sine or cosine. */
double wave(PolicyQuantity quantity, double cycles) {
  const double angle = 2 * M_PI * cycles;
  return quantity == PolicyQuantity::kPhaseSine ? std::sin(angle) : std::cos(angle);
}

}  // namespace

ObservationBuilder::ObservationBuilder(const PolicyManifest& manifest)
    : manifest_(&manifest), steps_(manifest.terms.size()) {
  observation_.reserve(static_cast<size_t>(manifest.num_observations()));
}

void ObservationBuilder::reset() {
  for (auto& steps : steps_) steps.clear();
}

std::vector<float> ObservationBuilder::calc_term(const PolicyTerm& term, const PolicyInput& input,
                                                 double phase,
                                                 const std::vector<float>& last_action) const {
  std::vector<double> raw;
  const auto take = [&raw](const auto& numbers) { raw.assign(numbers.begin(), numbers.end()); };
  switch (term.quantity) {
    case PolicyQuantity::kAngularVelocity:
      take(input.angular_velocity);
      break;
    case PolicyQuantity::kLinearVelocity:
      take(input.linear_velocity);
      break;
    case PolicyQuantity::kProjectedGravity:
      take(input.projected_gravity);
      break;
    case PolicyQuantity::kVelocityCommand:
      take(input.command);
      break;
    case PolicyQuantity::kLinearCommand:
      raw = {input.command.x(), input.command.y()};
      break;
    case PolicyQuantity::kTurnCommand:
      raw = {input.command.z()};
      break;
    case PolicyQuantity::kPhaseSine:
    case PolicyQuantity::kPhaseCosine: {
      const bool rests = input.command.isZero(0);
      for (const double lead : term.values) {
        double value = wave(term.quantity, phase + lead);
        if (rests && manifest_->phase_at_rest == Rest::kZeros) value = 0;
        if (rests && manifest_->phase_at_rest == Rest::kHalfCycle) value = wave(term.quantity, 0.5);
        raw.push_back(value);
      }
      break;
    }
    case PolicyQuantity::kJointPosition:
      for (const int motor : manifest_->observed_motors) {
        raw.push_back(input.joint_position[motor] - manifest_->default_position[motor]);
      }
      break;
    case PolicyQuantity::kJointVelocity:
      for (const int motor : manifest_->observed_motors) raw.push_back(input.joint_velocity[motor]);
      break;
    case PolicyQuantity::kLastAction:
      take(last_action);
      break;
    case PolicyQuantity::kConstant:
      raw = term.values;
      break;
  }
  std::vector<float> scaled(raw.size());
  for (size_t i = 0; i < raw.size(); ++i) {
    const double value = term.scale[i] * std::clamp(raw[i], -term.clip, term.clip);
    scaled[i] = static_cast<float>(
        std::clamp(value, -manifest_->observation_clip, manifest_->observation_clip));
  }
  return scaled;
}

const std::vector<float>& ObservationBuilder::build(const PolicyInput& input, double phase,
                                                    const std::vector<float>& last_action) {
  const std::vector<PolicyTerm>& terms = manifest_->terms;
  for (size_t i = 0; i < terms.size(); ++i) {
    auto& steps = steps_[i];
    std::vector<float> newest = calc_term(terms[i], input, phase, last_action);
    const std::vector<float> before =
        manifest_->starts_with_first ? newest : std::vector<float>(newest.size(), 0.0F);
    const auto count = static_cast<size_t>(terms[i].num_steps);
    while (steps.size() + 1 < count) steps.push_front(before);
    steps.push_back(std::move(newest));
    if (steps.size() > count) steps.pop_front();
  }
  observation_.clear();
  const auto append = [this](const std::deque<std::vector<float>>& steps, size_t index) {
    const std::vector<float>& step =
        steps[manifest_->is_newest_first ? steps.size() - 1 - index : index];
    observation_.insert(observation_.end(), step.begin(), step.end());
  };
  if (manifest_->is_by_step) {
    for (size_t k = 0; k < steps_.front().size(); ++k) {
      for (const auto& steps : steps_) append(steps, k);
    }
  } else {
    for (const auto& steps : steps_) {
      for (size_t k = 0; k < steps.size(); ++k) append(steps, k);
    }
  }
  return observation_;
}

}  // namespace nao
