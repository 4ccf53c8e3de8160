#include <algorithm>
#include <cmath>

#include "tools/nao-trial/lying_start.h"
#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kGetUpTimeout = 60;  // s, until it stands for good
constexpr int kMaxTries = 3;          // of a run that succeeds

std::vector<RunResult> run_get_up(const ScenarioOptions& options, uint64_t seed) {
  ClosedLoop trial(options.trial, seed);
  RunResult result;
  // With odd seeds the robot is pushed over, with even ones it is placed on the ground.
  const bool falls = seed % 2 == 1;
  result.label = falls ? "pushed" : "laid down";
  trial.run(0.5);
  if (!falls) {
    lay_down(trial, trial.random(-M_PI, M_PI));
  } else {
    trial.run(1.0 + trial.random(0, 0.5));
    if (!knock_over(trial, trial.random(-M_PI, M_PI))) {
      result.failure = "did not fall";
      return {result};
    }
  }
  // The time counts from when the robot lies still; before, no controller could begin.
  const auto [lies_on, start] = wait_until_still(trial);
  std::string side = lies_on;
  if (side == "left" || side == "right") side = "side";
  result.label += ", " + side;
  // Motion counts the tries from 1 again when the robot falls after it has got up.
  int num_tries = 0;
  int last_tries = 0;
  trial.on_tick([&] {
    const int tries = trial.core().motion_state().num_tries;
    num_tries += std::max(0, tries - last_tries);
    last_tries = tries;
  });
  double time = 0;
  bool is_up = false;
  do {
    is_up =
        trial.run_until([&] { return has_got_up(trial); }, start + kGetUpTimeout - trial.time());
    time = trial.time() - start;
  } while (is_up && !keeps_standing(trial));
  result.metrics.emplace_back("tries", num_tries);
  if (!is_up) {
    result.failure = "still down";
    return {result};
  }
  result.metrics.emplace_back("time_s", time);
  result.metrics.emplace_back("time_from_" + side + "_s", time);
  result.is_success = num_tries <= kMaxTries;
  if (!result.is_success) result.failure = "more than " + std::to_string(kMaxTries) + " tries";
  return {result};
}

}  // namespace

Scenario get_up_scenario() {
  return {"get-up",
          "Get up after a fall, or from a random lying pose",
          {{"time_s", "s"},
           {"time_from_belly_s", "s"},
           {"time_from_back_s", "s"},
           {"time_from_side_s", "s"}},
          run_get_up};
}

}  // namespace nao::trial
