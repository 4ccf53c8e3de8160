#include "policy/observation_builder.h"

#include <algorithm>
#include <cmath>

namespace nao {
namespace {

using Rest = PolicyManifest::PhaseAtRest;

/** A phase of the gait, cycles, as its sine or cosine. */
double wave(PolicyQuantity quantity, double cycles) {
  const double angle = 2 * M_PI * cycles;
  return quantity == PolicyQuantity::kPhaseSine ? std::sin(angle) : std::cos(angle);
}

}  // namespace

ObservationBuilder::ObservationBuilder(const PolicyManifest& manifest) : manifest_(&manifest) {
  for (const PolicyTerm& term : manifest.terms) {
    steps_.emplace_back(static_cast<size_t>(term.num_steps) * static_cast<size_t>(term.size));
  }
  observation_.reserve(static_cast<size_t>(manifest.num_observations()));
  reset();
}

void ObservationBuilder::reset(double lead) {
  has_begun_ = false;
  restart_phase(lead);
}

void ObservationBuilder::restart_phase(double lead) {
  phase_ = std::fmod(manifest_->phase_start + lead, 1.0);
}

void ObservationBuilder::advance_phase(const PolicyInput& input) {
  if (manifest_->phase_at_rest != Rest::kContinues && input.command.isZero(0)) {
    phase_ = manifest_->phase_start;
    return;
  }
  phase_ = std::fmod(phase_ + manifest_->period * manifest_->phase_frequency, 1.0);
}

void ObservationBuilder::calc_term(const PolicyTerm& term, const PolicyInput& input,
                                   const std::vector<float>& last_action, float* scaled) const {
  size_t count = 0;
  const auto put = [&](double value) {
    value = term.scale[count] * std::clamp(value, -term.clip, term.clip);
    scaled[count++] = static_cast<float>(
        std::clamp(value, -manifest_->observation_clip, manifest_->observation_clip));
  };
  const auto put_all = [&put](const auto& numbers) {
    std::for_each(numbers.begin(), numbers.end(), put);
  };
  switch (term.quantity) {
    case PolicyQuantity::kAngularVelocity:
      put_all(input.angular_velocity);
      break;
    case PolicyQuantity::kLinearVelocity:
      put_all(input.linear_velocity);
      break;
    case PolicyQuantity::kProjectedGravity:
      put_all(input.projected_gravity);
      break;
    case PolicyQuantity::kVelocityCommand:
      put_all(input.command);
      break;
    case PolicyQuantity::kLinearCommand:
      put_all(input.command.head<2>());
      break;
    case PolicyQuantity::kTurnCommand:
      put(input.command.z());
      break;
    case PolicyQuantity::kPhaseSine:
    case PolicyQuantity::kPhaseCosine: {
      const bool rests = input.command.isZero(0);
      for (const double lead : term.values) {
        double value = wave(term.quantity, phase_ + lead);
        if (rests && manifest_->phase_at_rest == Rest::kZeros) value = 0;
        if (rests && manifest_->phase_at_rest == Rest::kHalfCycle) value = wave(term.quantity, 0.5);
        put(value);
      }
      break;
    }
    case PolicyQuantity::kJointPosition:
      for (const int motor : manifest_->observed_motors) {
        put(input.joint_position[motor] - manifest_->default_position[motor]);
      }
      break;
    case PolicyQuantity::kJointVelocity:
      for (const int motor : manifest_->observed_motors) put(input.joint_velocity[motor]);
      break;
    case PolicyQuantity::kLastAction:
      put_all(last_action);
      break;
    case PolicyQuantity::kConstant:
      put_all(term.values);
      break;
  }
}

const std::vector<float>& ObservationBuilder::build(const PolicyInput& input,
                                                    const std::vector<float>& last_action) {
  if (has_begun_) advance_phase(input);
  const std::vector<PolicyTerm>& terms = manifest_->terms;
  for (size_t i = 0; i < terms.size(); ++i) {
    std::vector<float>& steps = steps_[i];
    const auto newest = steps.end() - terms[i].size;
    if (has_begun_) std::copy(steps.begin() + terms[i].size, steps.end(), steps.begin());
    calc_term(terms[i], input, last_action, &*newest);
    if (has_begun_) continue;
    // Before the first step.
    for (auto step = steps.begin(); step != newest; step += terms[i].size) {
      if (manifest_->starts_with_first) {
        std::copy(newest, steps.end(), step);
      } else {
        std::fill_n(step, terms[i].size, 0.0F);
      }
    }
  }
  has_begun_ = true;
  observation_.clear();
  const auto append = [&](size_t term, int index) {
    const int k = manifest_->is_newest_first ? terms[term].num_steps - 1 - index : index;
    const auto step = steps_[term].begin() + k * terms[term].size;
    observation_.insert(observation_.end(), step, step + terms[term].size);
  };
  if (manifest_->is_by_step) {
    for (int k = 0; k < terms.front().num_steps; ++k) {
      for (size_t i = 0; i < terms.size(); ++i) append(i, k);
    }
  } else {
    for (size_t i = 0; i < terms.size(); ++i) {
      for (int k = 0; k < terms[i].num_steps; ++k) append(i, k);
    }
  }
  return observation_;
}

}  // namespace nao
