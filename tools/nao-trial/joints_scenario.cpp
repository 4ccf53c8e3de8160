#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kDeepest = 0.01;  // s of self-contact force that a brush may last

/** A command for one to three random joints, valid or invalid. */
Command random_joint_command(ClosedLoop& trial) {
  JointChangeCommand change;
  const int num_joints = 1 + static_cast<int>(trial.random(0, 3));
  for (int i = 0; i < num_joints; ++i) {
    const int motor = static_cast<int>(trial.random(0, trial.model().num_motors()));
    const std::string& name = trial.model().motor_joint(motor).name;
    if (std::find(change.joint_names.begin(), change.joint_names.end(), name) !=
        change.joint_names.end()) {
      continue;
    }
    change.joint_names.push_back(name);
    // One in five is far out of range, and is clipped or refused.
    const double size = trial.random(0, 1) < 0.2 ? 10 : 0.8;
    change.joint_position.push_back(trial.random(-size, size));
  }
  change.is_relative = trial.random(0, 1) < 0.6;
  change.speed = trial.random(0.05, 1);
  // Names and speeds that must be refused.
  if (trial.random(0, 1) < 0.03) change.joint_names.back() = "Tail";
  if (trial.random(0, 1) < 0.03) change.speed = trial.random(-1, 3);
  return {"", 0, change};
}

std::vector<RunResult> run_joints(const ScenarioOptions& options, uint64_t seed) {
  const int num_commands = 100;
  ClosedLoopOptions trial_options = options.trial;
  trial_options.motion.gets_up = false;
  ClosedLoop trial(trial_options, seed);
  trial.run(1);
  RunResult result;
  std::vector<double> last = trial.targets();
  double self_contact_time = 0;
  const auto fail = [&](const std::string& why) {
    if (result.failure.empty()) result.failure = why;
  };
  trial.on_tick([&] {
    const std::vector<double>& targets = trial.targets();
    for (int motor = 0; motor < trial.model().num_motors(); ++motor) {
      const Joint& joint = trial.model().motor_joint(motor);
      // In every tick: speed, limits, self-contact in the truth of the simulator, and balance.
      if (std::abs(targets[motor] - last[motor]) >
          joint.max_velocity * trial.period() * (1 + 1e-9)) {
        fail(joint.name + " jumped");
      }
      const double clipped = trial.model().clip_to_limits(motor, targets[motor], targets);
      if (std::abs(clipped - targets[motor]) > 1e-6) fail(joint.name + " beyond its limits");
    }
    last = targets;
    for (const sim::Contact& contact : trial.world().contacts()) {
      if (contact.a.kind != sim::Surface::Kind::kRobot ||
          contact.b.kind != sim::Surface::Kind::kRobot) {
        continue;
      }
      self_contact_time += trial.period();
      if (self_contact_time <= kDeepest) continue;
      fail(fmt::format("{} touched {}", trial.model().links()[contact.a.link].name,
                       trial.model().links()[contact.b.link].name));
    }
    if (trial.torso_tilt() > 0.7) fail("fell");
  });
  int num_accepted = 0;
  int num_refused = 0;
  for (int i = 0; i < num_commands && result.failure.empty(); ++i) {
    trial.send(random_joint_command(trial));
    trial.run(trial.random(0.02, 1.0));
  }
  trial.run(3);
  for (const CommandResult& answer : trial.results()) {
    num_accepted += answer.status == ResultStatus::kAccepted ? 1 : 0;
    num_refused += answer.status == ResultStatus::kRefused ? 1 : 0;
  }
  result.is_success = result.failure.empty();
  result.metrics = {{"accepted", num_accepted}, {"refused", num_refused}};
  return {result};
}

}  // namespace

Scenario joints_scenario() {
  return {"joints",
          "Execute 100 random joint commands without a fall, self-collision or jump",
          {},
          run_joints};
}

}  // namespace nao::trial
