#include "tools/walk-tuner/gait_problem.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "common/text_file.h"
#include "tools/walk-tuner/gait_file.h"

namespace nao::tool {
namespace {

using motion::Gait;

// Weight of the squared distance of a candidate outside the ranges, in units of the ranges. Chosen:
// a tenth of a range outside costs as much as 10 % of velocity error.
constexpr double kOutsideCost = 10;

}  // namespace

GaitProblem::GaitProblem(GaitProblemOptions options, TrialConditions conditions, std::string text,
                         const Gait& start, std::vector<Gait::Parameter> parameters,
                         std::vector<Gait::Parameter> tuned)
    : options_(std::move(options)),
      conditions_(std::move(conditions)),
      course_(options_.speed),
      text_(std::move(text)),
      start_(start),
      parameters_(std::move(parameters)),
      tuned_(std::move(tuned)) {}

Eigen::VectorXd GaitProblem::start() const {
  Eigen::VectorXd point(tuned_.size());
  for (size_t i = 0; i < tuned_.size(); ++i) {
    const Gait::Parameter& p = tuned_[i];
    point[static_cast<long>(i)] = (p.value(start_) - p.lower) / (p.upper - p.lower);
  }
  return point;
}

Gait GaitProblem::gait_at(const Eigen::VectorXd& point) const {
  Gait gait = start_;
  for (size_t i = 0; i < tuned_.size(); ++i) {
    const Gait::Parameter& p = tuned_[i];
    p.in(gait) = p.lower + std::clamp(point[static_cast<long>(i)], 0.0, 1.0) * (p.upper - p.lower);
  }
  // The ranges of bounds and bounded values overlap.
  Gait::Timing& timing = gait.timing;
  timing.min_step_duration = std::min(timing.min_step_duration, timing.step_duration);
  timing.max_step_duration = std::max(timing.max_step_duration, timing.step_duration);
  double& least_separation = gait.step_limits.min_foot_separation;
  least_separation = std::min(least_separation, gait.stance.foot_separation);
  return gait;
}

Figures GaitProblem::run(const Task& task) const {
  // Walks of a course, then conditions, then courses: the first trials cover all walks.
  const int walk = task.trial % WalkCourse::kNumWalks;
  const int rest = task.trial / WalkCourse::kNumWalks;
  const int condition = rest % conditions_.count();
  const int course = rest / conditions_.count();
  ClosedLoopOptions trial = options_.trial;
  conditions_.apply(condition, trial);
  const Eigen::Map<const Eigen::VectorXd> point(task.point.data(),
                                                static_cast<long>(task.point.size()));
  const WalkResult result =
      course_.run(trial, gait_at(point), task.seed + static_cast<uint64_t>(course), walk);
  return {result.cost, result.has_fallen ? 1.0 : 0.0};
}

double GaitProblem::cost(const Eigen::VectorXd& point, const std::vector<Figures>& trials) const {
  double sum = 0;
  for (const Figures& trial : trials) sum += trial[0];
  const Eigen::VectorXd inside = point.cwiseMax(0).cwiseMin(1);
  return sum / static_cast<double>(trials.size()) + kOutsideCost * (point - inside).squaredNorm();
}

std::string GaitProblem::describe(const std::vector<Figures>& trials) const {
  const auto num_falls = std::count_if(trials.begin(), trials.end(),
                                       [](const Figures& trial) { return trial[1] > 0; });
  return fmt::format("{} falls in {} walks", num_falls, trials.size());
}

std::string GaitProblem::text(const Eigen::VectorXd& point) const {
  const Gait gait = gait_at(point);
  if (const auto found = gait.find_contradiction()) {
    throw Error(
        fmt::format("the gait is not written: {} {}", found->parameter, found->requirement));
  }
  return with_gait_values(text_, gait, parameters_);
}

std::map<std::string, std::string> GaitProblem::settings() const {
  // The starting point holds the gait file, --set and --only; the text its other values.
  std::string names;
  for (const Gait::Parameter& parameter : tuned_) names += parameter.name + " ";
  return {{"--courses", std::to_string(options_.courses)},
          {"--speed", fmt::format("{}", options_.speed)},
          {"--late", fmt::format("{}", options_.trial.missed_tick_probability)},
          {"robot files", fmt::format("{:016x}", options_.robot_digest)},
          {"tuned parameters", names},
          {"start", fmt::format("{:016x}", digest(with_gait_values(text_, start_, parameters_)))}};
}

}  // namespace nao::tool
