#include <vector>

#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kSessionDuration = 600;  // s

/** A random command that keeps the robot on its feet for a few seconds. */
void do_something(ClosedLoop& trial) {
  std::vector<const Posture*> postures;
  for (const Posture& posture : trial.model().postures()) {
    if (posture.family == "standing" || posture.family == "crouching") postures.push_back(&posture);
  }
  const double kind = trial.random(0, 3);
  if (kind < 1) {
    trial.hold_walk({trial.random(-0.1, 0.2), trial.random(-0.1, 0.1), trial.random(-0.5, 0.5)});
    trial.run(trial.random(2, 6));
    trial.release_walk();
    trial.run(2);
  } else if (kind < 2) {
    const auto index = static_cast<size_t>(trial.random(0, static_cast<double>(postures.size())));
    trial.await_end(trial.send_posture(postures[index]->name, trial.random(0.2, 1)), 10);
  } else {
    const int motor = static_cast<int>(trial.random(0, trial.model().num_motors()));
    JointChangeCommand change;
    change.joint_names = {trial.model().motor_joint(motor).name};
    change.joint_position = {trial.random(-0.6, 0.6)};
    change.is_relative = true;
    change.speed = trial.random(0.1, 1);
    trial.await_end(trial.send({"", 0, change}), 10);
  }
}

std::vector<RunResult> run_alarms(const ScenarioOptions& options, uint64_t seed) {
  const double duration = options.duration > 0 ? options.duration : kSessionDuration;
  ClosedLoop trial(options.trial, seed);
  int num_alarms = 0;
  bool was_falling = false;
  // Counts rising edges: one false alarm is one fall, however long it lasts.
  trial.on_tick([&] {
    const bool is_falling = trial.core().motion_state().mode == Mode::kFalling;
    num_alarms += is_falling && !was_falling ? 1 : 0;
    was_falling = is_falling;
  });
  trial.run(1);
  while (trial.time() < duration) do_something(trial);
  RunResult result;
  result.is_success = num_alarms == 0;
  if (!result.is_success) result.failure = "predicted a fall without a push";
  result.metrics = {{"alarms", num_alarms}, {"hours", trial.time() / 3600}};
  return {result};
}

}  // namespace

Scenario alarms_scenario() {
  return {"alarms",
          "Walk, change postures and turn joints for 10 minutes; count false fall predictions",
          {{"hours", "h"}},
          run_alarms};
}

}  // namespace nao::trial
