#include "tools/transition-tuner/get_up_problem.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/text_file.h"
#include "daemons/motion/transitions/transition_graph.h"

namespace nao {
namespace {

// Cost of a failed try, s: above the longest try of 14 s; and its reduction at full torso height,
// s, so that a failed try always costs as much as a success at the timeout.
constexpr double kFailed = 20;
constexpr double kHeightCounts = 6;
// Costs of a motor that is always at its peak torque, s, and of an angular acceleration of the
// torso of 1 rad/s^2, s. Chosen: load and shaking of a usual motion (0.8 and 20) are a tenth of its
// 5 s, so that they decide between motions of about the same time.
constexpr double kLoadCost = 0.4;
constexpr double kShakingCost = 0.01;
// Cost of the squared distance of a number outside its range, s/rad^2 and s/s^2.
constexpr double kOutsideCost = 10;

GetUpResult to_result(const Figures& figures) {
  return {figures[0] > 0, figures[1], figures[2], figures[3], figures[4]};
}

}  // namespace

double cost_of(const GetUpResult& result) {
  if (!result.is_up) return kFailed - kHeightCounts * result.height;
  return result.time + kLoadCost * result.load + kShakingCost * result.shaking;
}

GetUpProblem::GetUpProblem(GetUpProblemOptions options, TrialConditions conditions,
                           TransitionText text)
    : options_(std::move(options)),
      conditions_(std::move(conditions)),
      course_(parse_start(options_.start)),
      text_(std::move(text)),
      values_(text_.parameters().size()) {
  for (long i = 0; i < values_.size(); ++i) {
    const auto& parameter = text_.parameters()[static_cast<size_t>(i)];
    values_[i] = parameter.value;
    const bool is_chosen = parameter.keyframe >= options_.first_keyframe &&
                           parameter.keyframe <= options_.last_keyframe;
    if (is_chosen) chosen_.push_back(i);
  }
}

Eigen::VectorXd GetUpProblem::start() const {
  return values_(chosen_);
}

Figures GetUpProblem::run(const Task& task) const {
  ClosedLoopOptions trial = options_.trial;
  // Conditions before seeds: the first trials cover all conditions.
  conditions_.apply(task.trial % conditions_.count(), trial);
  const Eigen::Map<const Eigen::VectorXd> point(task.point.data(),
                                                static_cast<long>(task.point.size()));
  const auto graph = motion::TransitionGraph::parse(*trial.model, text(point));
  const GetUpResult result = course_.run(
      trial, graph, task.seed + static_cast<uint64_t>(task.trial / conditions_.count()));
  return {result.is_up ? 1.0 : 0.0, result.time, result.height, result.load, result.shaking};
}

double GetUpProblem::cost(const Eigen::VectorXd& point, const std::vector<Figures>& trials) const {
  double cost = 0;
  for (const Figures& figures : trials) cost += cost_of(to_result(figures));
  cost /= static_cast<double>(trials.size());
  for (size_t k = 0; k < chosen_.size(); ++k) {
    const auto& parameter = text_.parameters()[static_cast<size_t>(chosen_[k])];
    const double value = point[static_cast<long>(k)];
    cost += kOutsideCost * std::pow(value - std::clamp(value, parameter.lower, parameter.upper), 2);
  }
  return cost;
}

std::string GetUpProblem::describe(const std::vector<Figures>& trials) const {
  int num_up = 0;
  double time = 0;
  double load = 0;
  double shaking = 0;
  for (const Figures& figures : trials) {
    const GetUpResult result = to_result(figures);
    if (!result.is_up) continue;
    ++num_up;
    time += result.time;
    load += result.load;
    shaking += result.shaking;
  }
  const double n = std::max(1, num_up);
  return fmt::format("{} of {} up at the first try, {:.2f} s, load {:.2f}, shaking {:.1f} rad/s^2",
                     num_up, trials.size(), time / n, load / n, shaking / n);
}

std::string GetUpProblem::text(const Eigen::VectorXd& point) const {
  Eigen::VectorXd values = values_;
  values(chosen_) = point;
  return text_.with(values);
}

std::map<std::string, std::string> GetUpProblem::settings() const {
  return {{"--start", options_.start},
          {"--trials", std::to_string(options_.trials)},
          {"--keyframes", fmt::format("{} {}", options_.first_keyframe, options_.last_keyframe)},
          {"robot files", fmt::format("{:016x}", options_.robot_digest)},
          {"numbers", std::to_string(chosen_.size())},
          {"start", fmt::format("{:016x}", digest(text_.with(values_)))}};
}

}  // namespace nao
