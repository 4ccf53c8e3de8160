#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tools/nao-trial/scenarios.h"

namespace nao::trial {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kNumCommands = 100;       // of a run
constexpr double kPushShare = 0.03;     // of the commands, with a push that throws the robot over
constexpr double kRestartShare = 0.02;  // fraction of the commands after which the core restarts
constexpr double kTimeToEnd = 150;      // s for the last command, six tries to get up included

// Partly out of range, with speeds that must be refused.
Command random_joint_change(ClosedLoop& trial) {
  JointChangeCommand change;
  const int motor = static_cast<int>(trial.random(0, trial.model().num_motors()));
  change.joint_names = {trial.model().motor_joint(motor).name};
  change.joint_position = {trial.random(-2, 2)};
  change.is_relative = trial.random(0, 1) < 0.5;
  change.speed = trial.random(-0.05, 1.05);
  return {"", 0, change};
}

Command random_motion_command(ClosedLoop& trial) {
  const auto& postures = trial.model().postures();
  const auto& actions = trial.model().actions();
  const double kind = trial.random(0, 10);
  if (kind < 2) {
    const auto index = static_cast<size_t>(trial.random(0, static_cast<double>(postures.size())));
    return {"", 0, PostureCommand{postures[index].name, trial.random(0.1, 1.05)}};
  }
  if (kind < 4) {
    return {"", 0,
            WalkCommand{trial.random(-0.3, 0.3), trial.random(-0.2, 0.2), trial.random(-1, 1)}};
  }
  if (kind < 5) {
    return {"", 0,
            MoveToCommand{trial.random(-0.3, 0.3), trial.random(-0.2, 0.2), trial.random(-1, 1)}};
  }
  if (kind < 6) {
    const auto index = static_cast<size_t>(trial.random(0, static_cast<double>(actions.size())));
    return {"", 0, ActionCommand{actions[index].name, kNan, kNan, kNan}};
  }
  if (kind < 7) return {"", 0, StopCommand{}};
  return random_joint_change(trial);
}

/** Checks joint targets and results during a series of commands. */
class Watch {
 public:
  Watch(ClosedLoop& trial, RunResult& result) : trial_(trial), result_(result) {
    last_ = trial.targets();
    trial.on_tick([this] { tick(); });
  }
  ~Watch() { trial_.on_tick({}); }

  /** A new motion core starts; pending results of the old one are no longer expected. */
  void expect_restart() {
    forgiven_.clear();
    for (const auto& [id, is_open] : open_) {
      if (is_open) forgiven_[id] = true;
    }
  }
  void expect_result(int64_t id) { open_[id] = true; }
  bool has_open() const {
    return std::any_of(open_.begin(), open_.end(),
                       [this](const auto& one) { return one.second && !is_forgiven(one.first); });
  }
  void fail(const std::string& why) {
    if (result_.failure.empty()) result_.failure = why;
  }

 private:
  bool is_forgiven(int64_t id) const { return forgiven_.count(id) > 0; }

  // The two claims of this scenario: no target changes faster than its motor turns, and each
  // command gets exactly one final result.
  void tick() {
    const std::vector<double>& targets = trial_.targets();
    for (int motor = 0; motor < trial_.model().num_motors(); ++motor) {
      const Joint& joint = trial_.model().motor_joint(motor);
      const double change = std::abs(targets[motor] - last_[motor]);
      if (change > joint.max_velocity * trial_.period() * (1 + 1e-9)) fail(joint.name + " jumped");
    }
    last_ = targets;
    for (; next_ < trial_.results().size(); ++next_) take(trial_.results()[next_]);
  }

  void take(const CommandResult& answer) {
    if (answer.status == ResultStatus::kAccepted) return;
    if (!open_[answer.id] && !is_forgiven(answer.id)) {
      fail(fmt::format("{} got a second result", answer.id));
    }
    open_[answer.id] = false;
  }

  ClosedLoop& trial_;
  RunResult& result_;
  std::vector<double> last_;
  std::map<int64_t, bool> open_;
  std::map<int64_t, bool> forgiven_;
  size_t next_ = 0;
};

std::vector<RunResult> run_commands(const ScenarioOptions& options, uint64_t seed) {
  ClosedLoop trial(options.trial, seed);
  trial.run(1);
  RunResult result;
  Watch watch(trial, result);
  int num_pushes = 0;
  int num_restarts = 0;
  for (int i = 0; i < kNumCommands && result.failure.empty(); ++i) {
    watch.expect_result(trial.send(random_motion_command(trial)));
    trial.run(trial.random(0.02, 2.5));
    if (trial.random(0, 1) < kPushShare) {
      // 5 N s throws the robot over in any direction.
      const double direction = trial.random(-M_PI, M_PI);
      trial.world().push(0, 0, {5 * std::cos(direction), 5 * std::sin(direction), 0});
      ++num_pushes;
    }
    if (trial.random(0, 1) < kRestartShare) {
      trial.set_core_crashed(true);
      trial.run(trial.random(0.05, 0.5));
      trial.set_core_crashed(false);
      trial.restart_core();
      watch.expect_restart();
      ++num_restarts;
    }
  }
  // A walk ends only at another command.
  if (result.failure.empty()) watch.expect_result(trial.send({"", 0, StopCommand{}}));
  const bool all_ended =
      trial.run_until([&] { return !watch.has_open() || !result.failure.empty(); }, kTimeToEnd);
  if (!all_ended) watch.fail("a command got no result");
  result.is_success = result.failure.empty();
  result.metrics.emplace_back("pushes", num_pushes);
  result.metrics.emplace_back("restarts", num_restarts);
  return {result};
}

}  // namespace

Scenario commands_scenario() {
  return {"commands",
          "Answer 100 random commands in any mode, with pushes and restarts of the motion core",
          {},
          run_commands};
}

}  // namespace nao::trial
