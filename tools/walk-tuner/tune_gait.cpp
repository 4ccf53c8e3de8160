#include "tools/walk-tuner/tune_gait.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/text_file.h"
#include "common/yaml_entry.h"
#include "daemons/motion/walk/gait.h"
#include "sim/closed_loop/closed_loop.h"
#include "tools/tuning/search_run.h"
#include "tools/tuning/trial_conditions.h"
#include "tools/tuning/tuning_problem.h"
#include "tools/walk-tuner/gait_file.h"
#include "tools/walk-tuner/walk_course.h"
#include "tuner_texts.h"

namespace nao::tool {
namespace {

/** Search problem of the walk tuner. */
struct GaitProblemOptions {
  /** Model, scene and late ticks of all walks. */
  ClosedLoopOptions trial;
  /** Fraction of the model's walk limits that is commanded. */
  double speed = 1;
  /** Courses of each candidate, for each engine and set of disturbances. */
  int courses = 1;
  /** Digest of the robot's other files, from digest_files(). */
  uint64_t robot_digest = 0;
};

/** Search of a gait's parameters. A candidate is a point of the unit cube of their ranges; a trial
 * is one walk of a course. */
class GaitProblem : public TuningProblem {
 public:
  /** @param text        Text of the gait file that the search starts from.
   * @param start       Its gait, with other values where the command line sets them.
   * @param parameters  All parameters of the file. @param tuned       Parameters that are searched.
   */
  GaitProblem(GaitProblemOptions options, TrialConditions conditions, std::string text,
              const motion::Gait& start, std::vector<motion::Gait::Parameter> parameters,
              std::vector<motion::Gait::Parameter> tuned);

  Eigen::VectorXd start() const override;
  int num_trials() const override {
    return options_.courses * conditions_.count() * WalkCourse::kNumWalks;
  }
  int num_seeds() const override { return options_.courses; }
  Figures run(const Task& task) const override;
  double cost(const Eigen::VectorXd& point, const std::vector<Figures>& trials) const override;
  std::string describe(const std::vector<Figures>& trials) const override;
  std::string text(const Eigen::VectorXd& point) const override;
  std::map<std::string, std::string> settings() const override;

 private:
  /** Coordinates outside the cube are clamped. */
  motion::Gait gait_at(const Eigen::VectorXd& point) const;

  GaitProblemOptions options_;
  TrialConditions conditions_;
  WalkCourse course_;
  std::string text_;
  motion::Gait start_;
  std::vector<motion::Gait::Parameter> parameters_;
  std::vector<motion::Gait::Parameter> tuned_;
};

using motion::Gait;

// Weight of the squared distance of a candidate outside the ranges, in units of the ranges. Chosen:
// a tenth of a range outside costs as much as 10 % of velocity error.
constexpr double kOutsideCost = 10;

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

using motion::Gait;

/** Whether a search without --only leaves it as it is. */
bool is_left(const std::string& name) {
  const std::string text(kTunerTexts.at("not_tuned"));
  const auto names = YamlEntry::parse<ConfigError>(text, "not_tuned.yaml").items();
  return std::any_of(names.begin(), names.end(),
                     [&](const auto& each) { return each.text() == name; });
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Applies "GROUP.KEY=NUMBER" settings. @throws ConfigError */
void apply(const std::vector<std::string>& settings, const std::vector<Gait::Parameter>& parameters,
           Gait& gait) {
  for (const std::string& setting : settings) {
    const size_t at = setting.find('=');
    const auto found = std::find_if(
        parameters.begin(), parameters.end(),
        [&](const Gait::Parameter& parameter) { return setting.substr(0, at) == parameter.name; });
    char* end = nullptr;
    const double value = at == std::string::npos ? 0 : std::strtod(setting.c_str() + at + 1, &end);
    if (found == parameters.end() || end == nullptr || *end != 0) {
      throw ConfigError("--set " + setting +
                        " is not GROUP.KEY=NUMBER with a parameter of the gait file");
    }
    found->in(gait) = value;
  }
}

/** Parameters to tune. @throws ConfigError  if there are fewer than two. */
std::vector<Gait::Parameter> choose_tuned(const TunerOptions& options,
                                          const std::vector<Gait::Parameter>& parameters) {
  std::vector<Gait::Parameter> tuned;
  for (const Gait::Parameter& parameter : parameters) {
    const bool is_tuned =
        options.only.empty() ? !is_left(parameter.name) : contains(options.only, parameter.name);
    if (is_tuned) tuned.push_back(parameter);
  }
  if (tuned.size() < 2) {
    throw ConfigError("--only must name at least two parameters of the gait file, GROUP.KEY each");
  }
  return tuned;
}

}  // namespace

void tune_gait(const TunerOptions& options) {
  const std::filesystem::path& folder = options.folder;
  const std::filesystem::path file =
      options.gait_file.empty() ? folder / "gait.yaml" : std::filesystem::path(options.gait_file);
  GaitProblemOptions problem_options;
  problem_options.trial.model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  problem_options.trial.scene = SceneFile::find("empty");
  problem_options.trial.missed_tick_probability = options.late_probability;
  problem_options.speed = options.speed;
  problem_options.courses = options.courses;
  problem_options.robot_digest = digest_files(folder, file);
  std::vector<Gait::Parameter> parameters;
  Gait gait = Gait::load(file, &parameters);
  apply(options.settings, parameters, gait);
  const GaitProblem problem(problem_options,
                            TrialConditions(options.search.engines, options.search.disturbances),
                            read_file(file), gait, parameters, choose_tuned(options, parameters));
  run_on_workers(options.search, problem, options.is_check);
}

}  // namespace nao::tool
