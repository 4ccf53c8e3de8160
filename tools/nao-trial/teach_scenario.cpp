#include "tools/nao-trial/scenarios.h"

#include <fmt/format.h>

#include "common/wall_clock.h"
#include "daemons/motion-files/motion_checker.h"
#include "daemons/motion-files/rollout.h"
#include "tools/nao-trial/teach_motions.h"

namespace nao::trial {
namespace {

// Draws of the disturbances with which a motion is played. Chosen: a motion counts as safe if it is
// safe on three robots.
constexpr int kNumPlays = 3;
// Far from the seeds of the checker.
constexpr uint64_t kPlaySeed = 5000000;

std::string describe_fault(const motion::MotionFault& fault) {
  return fmt::format("keyframe {}: {}", fault.keyframe + 1, to_sentence(fault.reason));
}

/** One check, and what the motion does when it is played. */
RunResult check_and_play(const ScenarioOptions& options, const motion::ActionScript& script,
                         uint64_t seed) {
  MotionChecker checker(options.trial);
  const double start = monotonic_seconds();
  const MotionReport report = checker.check(script);
  RunResult result;
  result.metrics.emplace_back("check_s", monotonic_seconds() - start);
  const bool is_accepted = !report.fault;
  std::optional<motion::MotionFault> fault;
  for (uint64_t i = 0; i < kNumPlays && !fault; ++i) {
    fault = roll_out(options.trial, kPlaySeed + kNumPlays * seed + i, report.script);
  }
  // A Stop must be safe at any time of the motion.
  const double stop_time = 0.3 + 0.37 * static_cast<double>(seed % 7);
  std::optional<motion::MotionFault> stop_fault;
  if (is_accepted && !fault) {
    RolloutEnd end;
    end.stop_time = stop_time;
    stop_fault = roll_out(options.trial, kPlaySeed + kNumPlays * seed, report.script, end);
  }
  result.label = is_accepted ? "accepted" : report.fault->reason.code;
  result.metrics.emplace_back("accepted", is_accepted ? 1 : 0);
  result.metrics.emplace_back("safe", fault ? 0 : 1);
  result.metrics.emplace_back("wrongly_accepted", is_accepted && fault ? 1 : 0);
  result.metrics.emplace_back("wrongly_refused", !is_accepted && !fault ? 1 : 0);
  result.metrics.emplace_back("repaired", report.repaired ? 1 : 0);
  result.is_success = !is_accepted || (!fault && !stop_fault);
  // Shows why a motion was refused without need.
  if (!is_accepted && !fault) result.failure = describe_fault(*report.fault);
  if (is_accepted && fault) result.failure = "accepted, but " + describe_fault(*fault);
  if (stop_fault) {
    result.failure =
        fmt::format("stopped after {:.2f} s: {}", stop_time, describe_fault(*stop_fault));
  }
  // Refused motions, to check whether a person understands the reason.
  if (!is_accepted && report.fault->keyframe < 0) {
    result.is_success = false;
    result.failure = "refused without a keyframe: " + to_sentence(report.fault->reason);
  }
  return result;
}

std::vector<RunResult> run_teach(const ScenarioOptions& options, uint64_t seed) {
  return {check_and_play(options, draw_taught_motion(*options.trial.model, seed), seed)};
}

std::vector<RunResult> run_teach_good(const ScenarioOptions& options, uint64_t seed) {
  const auto motions = make_good_motions(*options.trial.model);
  const uint64_t number = seed % motions.size();
  RunResult result = check_and_play(options, motions[number], seed);
  if (result.is_success && result.label != "accepted") {
    result.is_success = false;
    result.failure =
        fmt::format("motion {} was refused: {} {}", number, result.label, result.failure);
  }
  return {result};
}

}  // namespace

Scenario teach_scenario() {
  return {"teach",
          "Check and play taught motions: random ones, half of them near postures",
          {{"check_s", "s"}},
          run_teach};
}

Scenario teach_good_scenario() {
  return {"teach-good",
          "Check and play taught motions: hand-made ones, of which none may be refused",
          {{"check_s", "s"}},
          run_teach_good};
}

}  // namespace nao::trial
