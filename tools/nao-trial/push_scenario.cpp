#include <algorithm>
#include <cmath>
#include <optional>

#include "nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kLeast = 0.2;     // N s
constexpr double kGreatest = 4.0;  // N s
constexpr int kNumHalvings = 6;
constexpr double kWatch = 2.5;  // s after the push

struct Outcome {
  bool stands = false;
  /** s from the first sign of a fall in the motion core to the first touch of something else than a
   * foot; nothing if it stood, negative if it came too late. */
  std::optional<double> warning;
};

bool touches_floor_with_body(Trial& trial) {
  const RobotModel& model = trial.model();
  for (const sim::Contact& contact : trial.world().contacts()) {
    if (contact.a.kind != sim::Surface::Kind::kFloor &&
        contact.b.kind != sim::Surface::Kind::kFloor) {
      continue;
    }
    const sim::Surface& body = contact.a.kind == sim::Surface::Kind::kRobot ? contact.a : contact.b;
    const std::string& name = model.links()[body.link].name;
    if (name.find("Foot") == std::string::npos && name.find("Sole") == std::string::npos)
      return true;
  }
  return false;
}

Outcome push(const ScenarioOptions& options, uint64_t seed, double direction, double impulse) {
  TrialOptions trial_options = options.trial;
  trial_options.motion.gets_up = false;
  Trial trial(trial_options, seed);
  trial.run(0.5);
  trial.world().push(0, 0, {impulse * std::cos(direction), impulse * std::sin(direction), 0});
  std::optional<double> told;
  std::optional<double> touched;
  trial.on_tick([&] {
    if (!told && trial.core().motion_state().mode == motion::Mode::kFalling) told = trial.time();
    if (!touched && touches_floor_with_body(trial)) touched = trial.time();
  });
  trial.run(kWatch);
  Outcome outcome;
  outcome.stands = !touched && trial.torso_tilt() < 0.3 && trial.torso_height() > 0.28;
  if (touched) outcome.warning = told ? *touched - *told : -1.0;
  return outcome;
}

}  // namespace

std::vector<RunResult> PushScenario::run(const ScenarioOptions& options, uint64_t seed) const {
  // Directions of the impulse, and what must be survived, N s.
  const struct {
    const char* name;
    double direction;
    double least;
  } cases[] = {{"forward", 0, 1.2},
               {"backward", M_PI, 0.9},
               {"left", M_PI / 2, 1.2},
               {"right", -M_PI / 2, 1.2}};
  std::vector<RunResult> results;
  for (const auto& one : cases) {
    RunResult result;
    result.label = one.name;
    double survived = kLeast;
    double lost = kGreatest;
    for (int i = 0; i < kNumHalvings; ++i) {
      const double impulse = (survived + lost) / 2;
      const Outcome outcome = push(options, seed, one.direction, impulse);
      (outcome.stands ? survived : lost) = impulse;
      if (outcome.warning) result.metrics.emplace_back("warning_ms", *outcome.warning * 1e3);
    }
    result.metrics.emplace_back(std::string(one.name) + "_impulse_Ns", survived);
    result.metrics.emplace_back("impulse_Ns", survived);
    result.is_success = survived >= one.least;
    if (!result.is_success) result.failure = "fell at less than asked for";
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace nao::trial
