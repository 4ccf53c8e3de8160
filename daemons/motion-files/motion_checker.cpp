#include "daemons/motion-files/motion_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/constants.h"
#include "daemons/motion-files/rollout.h"
#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/transitions/keyframes.h"

namespace nao {
namespace {

using motion::ActionScript;
using motion::Keyframe;
using motion::KeyframePlayer;
using motion::MotionFault;

// Excess over a limit that a measured pose may have, rad (1.1 degrees): play and noise of the
// encoder, and a servo that is pressed against its stop.
constexpr double kLimitTolerance = 0.02;
// Passes of a repeated motion that are checked: the second one starts from the last keyframe, and
// all others are like it.
constexpr int kCheckedPasses = 2;
// Sampling of the path for the distances of the links: period, s, and least change of an angle,
// rad. Chosen as for joint changes: the end of an arm, 0.2 m from its shoulder, then moves by 1 cm.
constexpr double kPathPeriod = 0.005;
constexpr double kPathAngle = 0.05;
// Least distance of two links on the path, m: less than for joint changes, because simulations of
// the motion show contacts, too. Chosen with nao-trial teach: with 3 mm, a tenth of the motions
// without contacts were refused.
constexpr double kClearance = 0.001;
// Simulated pause, s: a robot that has not fallen by its end stands still.
constexpr double kSimulatedPause = 1.5;
// Simulations of a motion, and the simulated time that all of them may take, s. Chosen: measured by
// nao-trial teach, see docs/performance.md; the time keeps the longest motions below half a minute.
constexpr int kNumRollouts = 6;
constexpr double kRolloutBudget = 400;
// Seeds of these simulations, which trials do not use.
constexpr uint64_t kFirstSeed = 900001;
// Factors by which a motion that falls is slowed down.
constexpr double kSlowFactors[] = {1.5, 2.5};
// Factor by which a keyframe becomes longer than its motors need.
constexpr double kSpeedReserve = 1.02;

/** The motion as it is checked: pauses cut, and no more passes than needed. */
ActionScript shortened(const ActionScript& script) {
  ActionScript result = script;
  result.num_repetitions = std::min(script.num_repetitions, kCheckedPasses);
  for (Keyframe& keyframe : result.sequence.keyframes) {
    keyframe.pause = std::min(keyframe.pause, kSimulatedPause);
  }
  return result;
}

}  // namespace

MotionChecker::MotionChecker(const ClosedLoopOptions& options)
    : options_(options), model_(options.model.get()), guard_(*options.model, kClearance) {}

MotionReport MotionChecker::check(const ActionScript& script) {
  MotionReport report;
  report.script = script;
  clip(report.script, kLimitTolerance);
  report.fault = find_static_fault(report.script);
  if (!report.fault) report.fault = find_dynamic_fault(report.script);
  if (report.fault) repair(report);
  return report;
}

std::vector<std::vector<double>> MotionChecker::calc_targets(const ActionScript& script) const {
  const Posture* start = model_->find_posture(script.start);
  std::vector<std::vector<double>> targets = {start != nullptr ? start->position
                                                               : model_->ready_posture().position};
  for (const Keyframe& keyframe : script.sequence.keyframes) {
    targets.push_back(targets.back());
    for (int motor = 0; motor < model_->num_motors(); ++motor) {
      if (!std::isnan(keyframe.position[motor])) targets.back()[motor] = keyframe.position[motor];
    }
  }
  return targets;
}

std::optional<MotionFault> MotionChecker::find_static_fault(const ActionScript& script) {
  if (auto fault = motion::find_form_fault(script)) return fault;
  if (auto fault = find_limit_fault(script)) return fault;
  if (auto fault = find_speed_fault(script)) return fault;
  return find_collision(script);
}

std::optional<MotionFault> MotionChecker::find_limit_fault(const ActionScript& script) const {
  const auto targets = calc_targets(script);
  for (size_t k = 1; k < targets.size(); ++k) {
    std::vector<double> clipped = targets[k];
    motion::clip_to_limits(*model_, clipped);
    for (int motor = 0; motor < model_->num_motors(); ++motor) {
      const double excess = std::abs(targets[k][motor] - clipped[motor]);
      if (excess < 1e-9) continue;
      return MotionFault{static_cast<int>(k) - 1,
                         Reason("motion-beyond-limit", {model_->motor_names()[motor],
                                                        fmt::format("{:.1f}", excess / kDegree)})};
    }
  }
  return std::nullopt;
}

std::optional<MotionFault> MotionChecker::find_speed_fault(const ActionScript& script) const {
  auto targets = calc_targets(script);
  // The second pass comes from the last keyframe.
  for (int pass = 0; pass < std::min(script.num_repetitions, kCheckedPasses); ++pass) {
    for (size_t k = 1; k < targets.size(); ++k) {
      for (int motor = 0; motor < model_->num_motors(); ++motor) {
        const double distance = std::abs(targets[k][motor] - targets[k - 1][motor]);
        const double needed =
            motion::kMinDurationRatio * distance / model_->motor_joint(motor).max_velocity;
        if (needed <= script.sequence.keyframes[k - 1].duration * (1 + 1e-9)) continue;
        return MotionFault{static_cast<int>(k) - 1,
                           Reason("motion-too-fast", {model_->motor_names()[motor],
                                                      fmt::format("{:.2f}", needed + 0.005)})};
      }
    }
    targets.front() = targets.back();
  }
  return std::nullopt;
}

std::optional<MotionFault> MotionChecker::find_collision(const ActionScript& script) {
  std::vector<std::vector<double>> path = {calc_targets(script).front()};
  std::vector<int> keyframes = {0};
  std::vector<double> position = path.front();
  std::vector<double> stiffness(position.size(), 1.0);
  for (int pass = 0; pass < std::min(script.num_repetitions, kCheckedPasses); ++pass) {
    const KeyframePlayer player(*model_, script.sequence, position, 1.0);
    for (double time = kPathPeriod; time < player.duration() + kPathPeriod; time += kPathPeriod) {
      player.sample(time, position, stiffness);
      double largest = 0;
      for (size_t i = 0; i < position.size(); ++i) {
        largest = std::max(largest, std::abs(position[i] - path.back()[i]));
      }
      if (largest < kPathAngle && time < player.duration()) continue;
      path.push_back(position);
      keyframes.push_back(player.stage_at(time));
    }
  }
  // Links may come as near to each other as they are at the start, or in a posture of the robot's
  // own: those are tried in turn. Where the path leaves one of them, the next is searched.
  std::vector<double> reference = path.front();
  size_t index = 0;
  while (true) {
    std::vector<std::vector<double>> rest = {reference};
    rest.insert(rest.end(), path.begin() + static_cast<std::ptrdiff_t>(index), path.end());
    motion::SelfCollision collision;
    const size_t last = guard_.find_last_free(rest, collision);
    if (last + 1 == rest.size()) return std::nullopt;
    // `rest` begins with the reference, so this is the point after the last free one.
    index += last;
    const auto nearer = std::find_if(
        model_->postures().begin(), model_->postures().end(), [&](const Posture& posture) {
          motion::SelfCollision other;
          return guard_.find_last_free({posture.position, path[index]}, other) == 1;
        });
    if (nearer == model_->postures().end()) {
      return MotionFault{keyframes[index],
                         Reason("motion-self-contact", {collision.link_a, collision.link_b})};
    }
    reference = nearer->position;
  }
}

std::optional<MotionFault> MotionChecker::find_dynamic_fault(const ActionScript& script) const {
  const ActionScript checked = shortened(script);
  const double duration = checked.num_repetitions * checked.sequence.duration();
  const int num_rollouts = std::clamp(static_cast<int>(kRolloutBudget / duration), 1, kNumRollouts);
  for (int i = 0; i < num_rollouts; ++i) {
    RolloutEnd end;
    end.is_cancelled = &is_cancelled_;
    if (auto fault = roll_out(options_, kFirstSeed + i, checked, end)) return fault;
  }
  return std::nullopt;
}

void MotionChecker::clip(ActionScript& script, double tolerance) const {
  for (size_t k = 0; k < script.sequence.keyframes.size(); ++k) {
    // Recomputed for each keyframe: the next ones continue from what was clipped.
    const std::vector<double> target = calc_targets(script)[k + 1];
    std::vector<double> clipped = target;
    motion::clip_to_limits(*model_, clipped);
    for (int motor = 0; motor < model_->num_motors(); ++motor) {
      const double excess = std::abs(target[motor] - clipped[motor]);
      if (excess == 0 || excess > tolerance) continue;
      script.sequence.keyframes[k].position[motor] = clipped[motor];
    }
  }
}

void MotionChecker::slow_down(ActionScript& script, double factor) const {
  const auto targets = calc_targets(script);
  for (size_t k = 1; k < targets.size(); ++k) {
    double& duration = script.sequence.keyframes[k - 1].duration;
    duration *= factor;
    for (int motor = 0; motor < model_->num_motors(); ++motor) {
      double distance = std::abs(targets[k][motor] - targets[k - 1][motor]);
      if (k == 1 && script.num_repetitions > 1) {
        distance = std::max(distance, std::abs(targets[k][motor] - targets.back()[motor]));
      }
      duration = std::max(duration, kSpeedReserve * motion::kMinDurationRatio * distance /
                                        model_->motor_joint(motor).max_velocity);
    }
    duration = std::min(duration, motion::TaughtMotionBounds::kMaxDuration);
  }
}

void MotionChecker::repair(MotionReport& report) {
  const auto try_out = [&](ActionScript candidate, const char* what) {
    slow_down(candidate, 1);
    if (find_static_fault(candidate) || find_dynamic_fault(candidate)) return false;
    report.repaired = std::move(candidate);
    report.repair = what;
    return true;
  };
  const std::string& code = report.fault->reason.code;
  if (code == "motion-beyond-limit") {
    ActionScript candidate = report.script;
    clip(candidate, std::numeric_limits<double>::infinity());
    try_out(std::move(candidate), "clipped");
  } else if (code == "motion-too-fast") {
    try_out(report.script, "slowed-down");
  } else if (code == "motion-fall") {
    for (const double factor : kSlowFactors) {
      ActionScript candidate = report.script;
      slow_down(candidate, factor);
      if (try_out(std::move(candidate), "slowed-down")) return;
    }
  }
}

}  // namespace nao
