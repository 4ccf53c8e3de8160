#include "tools/nao-trial/scenarios.h"

#include <algorithm>

namespace nao::trial {
namespace {

std::vector<RunResult> run_stand(const ScenarioOptions& options, uint64_t seed) {
  const double duration = options.duration > 0 ? options.duration : 60;
  ClosedLoop trial(options.trial, seed);
  // The robot first moves to its stand.
  trial.run(2);
  const Eigen::Vector3d start = trial.torso_in_world().translation();
  double drift = 0;
  double tilt = 0;
  trial.on_tick([&] {
    drift = std::max(drift, (trial.torso_in_world().translation() - start).norm());
    tilt = std::max(tilt, trial.torso_tilt());
  });
  trial.run(duration);
  RunResult result;
  result.is_success =
      tilt < 0.3 && trial.torso_height() > 0.9375 * trial.model().references().heights.standing;
  if (!result.is_success) result.failure = "fell";
  result.metrics = {{"drift_mm", drift * 1e3}, {"torso_height_m", trial.torso_height()}};
  return {result};
}

}  // namespace

Scenario stand_scenario() {
  return {"stand",
          "Stand still in StandInit for 60 s",
          {{"drift_mm", "mm"}, {"torso_height_m", "m"}},
          run_stand};
}

}  // namespace nao::trial
