#include <fmt/core.h>

#include "common/constants.h"
#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kSpeed = 0.5;   // fraction of the fastest motion
constexpr double kTimeout = 60;  // s for one way, getting up and trying again included
// Greatest difference of a joint from the posture, rad.
constexpr double kTolerance = 3 * kDegree;
constexpr double kLyingTolerance = 8 * kDegree;

/** Moves from one posture to another. @return Cause of the failure; empty on success. */
std::string go(ClosedLoop& trial, const Posture& goal, RunResult& result) {
  const double start = trial.time();
  const auto end = trial.await_end(trial.send_posture(goal.name, kSpeed), kTimeout);
  if (!end) return "no result";
  if (end->status != ResultStatus::kDone) {
    return std::string(to_string(end->status)) + ": " + to_sentence(end->reason);
  }
  result.metrics.emplace_back("time_s", trial.time() - start);
  trial.run(0.3);
  std::string joint;
  const double deviation = trial.deviation_from(goal, &joint);
  result.metrics.emplace_back("deviation_deg", deviation / kDegree);
  if (deviation > (goal.is_lying() ? kLyingTolerance : kTolerance)) {
    return fmt::format("{} is {:.1f} degrees off", joint, deviation / kDegree);
  }
  const bool is_upright = goal.family == "standing" || goal.family == "crouching";
  if (is_upright && trial.torso_tilt() > 0.3) return "fell";
  return "";
}

std::vector<RunResult> run_posture_graph(const ScenarioOptions& options, uint64_t seed) {
  std::vector<RunResult> results;
  const auto& postures = options.trial.model->postures();
  // Tries every ordered pair of postures, each with a new robot, so that a failure does not affect
  // the next pair.
  for (const Posture& from : postures) {
    for (const Posture& to : postures) {
      if (&from == &to) continue;
      RunResult result;
      result.label = from.name + " to " + to.name;
      ClosedLoop trial(options.trial, seed);
      trial.run(1);
      RunResult way_there;
      result.failure = go(trial, from, way_there);
      if (!result.failure.empty()) {
        result.failure = "on the way to the start: " + result.failure;
      } else {
        result.failure = go(trial, to, result);
      }
      result.is_success = result.failure.empty();
      results.push_back(std::move(result));
    }
  }
  return results;
}

}  // namespace

Scenario posture_graph_scenario() {
  return {"posture-graph",
          "Go from every posture to every other one",
          {{"time_s", "s"}, {"deviation_deg", "degrees"}},
          run_posture_graph};
}

}  // namespace nao::trial
