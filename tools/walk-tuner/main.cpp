#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/program.h"
#include "tools/tuning/cma_es.h"
#include "tools/tuning/search.h"
#include "tools/walk-tuner/gait_file.h"
#include "tools/walk-tuner/walk_course.h"

namespace nao::tool {
namespace {

using motion::Gait;

struct TunerOptions {
  SearchOptions search = {
      .output = "gait.yaml", .generations = 30, .population = 14, .sigma = 0.05};
  std::string gait_file;
  std::vector<std::string> only;
  std::vector<std::string> settings;
  int courses = 1;
  double speed = 1;
  double late_probability = 0.01;
  bool is_check = false;
};

// Not tuned unless --only names them. The course does not measure what they trade off: a search
// would set bounds as wide, durations as short and arms wherever it lowers the cost a little.
const std::vector<std::string> kNotTuned = {
    "timing.start_duration",
    "timing.stop_duration",
    "timing.raise_duration",
    "stance.turn_center",
    "step_limits.max_forward",
    "step_limits.max_backward",
    "step_limits.max_outward",
    "step_limits.min_foot_separation",
    "step_limits.max_turn_outward",
    "step_limits.max_turn_inward",
    "velocity.max_change_vx",
    "velocity.max_change_vy",
    "velocity.max_change_wz",
    "velocity.envelope_exponent",
    "kick.ball_distance",
    "kick.swing_reach",
    "kick.swing_lift",
};
// Weight of the squared distance of a candidate outside the ranges, in units of the ranges. Chosen:
// a tenth of a range outside costs as much as 10 % of velocity error.
constexpr double kOutsideCost = 10;
// First seed of the courses of --check: none that a search uses.
constexpr uint64_t kCheckSeed = 1000000;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Maps gaits to points of the unit cube of the tuned parameters' ranges. */
class GaitSpace {
 public:
  GaitSpace(Gait base, std::vector<Gait::Parameter> parameters)
      : base_(base), parameters_(std::move(parameters)) {}

  /** Of the gait that the search starts from. */
  Eigen::VectorXd point() const {
    Eigen::VectorXd point(parameters_.size());
    for (size_t i = 0; i < parameters_.size(); ++i) {
      const Gait::Parameter& p = parameters_[i];
      point[static_cast<long>(i)] = (p.value(base_) - p.lower) / (p.upper - p.lower);
    }
    return point;
  }
  /** Coordinates outside the cube are clamped. */
  Gait gait(const Eigen::VectorXd& point) const {
    Gait gait = base_;
    for (size_t i = 0; i < parameters_.size(); ++i) {
      const Gait::Parameter& p = parameters_[i];
      p.in(gait) =
          p.lower + std::clamp(point[static_cast<long>(i)], 0.0, 1.0) * (p.upper - p.lower);
    }
    return gait;
  }

 private:
  Gait base_;
  std::vector<Gait::Parameter> parameters_;
};

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

/** Runs every candidate on the same courses; the result does not depend on the number of threads.
 */
std::vector<CourseResult> evaluate(const WalkCourse& course, const std::vector<Gait>& gaits,
                                   const TunerOptions& options, uint64_t first_seed) {
  std::vector<CourseResult> results(gaits.size());
  for_each_index(gaits.size(), options.search.jobs, [&](size_t i) {
    for (int k = 0; k < options.courses; ++k) {
      const CourseResult result = course.run(gaits[i], first_seed + static_cast<uint64_t>(k));
      results[i].cost += result.cost / options.courses;
      results[i].num_walks += result.num_walks;
      results[i].num_falls += result.num_falls;
    }
  });
  return results;
}

/** Parameters to tune. @throws ConfigError  if there are fewer than two. */
std::vector<Gait::Parameter> choose_tuned(const TunerOptions& options,
                                          const std::vector<Gait::Parameter>& parameters) {
  std::vector<Gait::Parameter> tuned;
  for (const Gait::Parameter& parameter : parameters) {
    const bool is_tuned = options.only.empty() ? !contains(kNotTuned, parameter.name)
                                               : contains(options.only, parameter.name);
    if (is_tuned) tuned.push_back(parameter);
  }
  if (tuned.size() < 2) {
    throw ConfigError("--only must name at least two parameters of the gait file, GROUP.KEY each");
  }
  return tuned;
}

void search(const TunerOptions& options, const WalkCourse& course, const Gait& start,
            const std::vector<Gait::Parameter>& parameters, const std::string& text) {
  const GaitSpace space(start, choose_tuned(options, parameters));
  CmaEs search(space.point(), options.search.sigma, options.search.population, options.search.seed);
  for (int generation = 1; generation <= options.search.generations; ++generation) {
    const std::vector<Eigen::VectorXd> candidates = search.ask();
    std::vector<Gait> gaits;
    for (const Eigen::VectorXd& candidate : candidates) gaits.push_back(space.gait(candidate));
    // All candidates of a generation walk the same courses, each generation new ones.
    const auto courses = static_cast<uint64_t>(options.courses);
    const uint64_t first_seed =
        options.search.seed * 10000 + static_cast<uint64_t>(generation) * courses;
    const std::vector<CourseResult> results = evaluate(course, gaits, options, first_seed);
    std::vector<double> costs;
    CourseResult sum;
    for (size_t i = 0; i < results.size(); ++i) {
      const Eigen::VectorXd inside = candidates[i].cwiseMax(0).cwiseMin(1);
      costs.push_back(results[i].cost + kOutsideCost * (candidates[i] - inside).squaredNorm());
      sum.cost += results[i].cost / static_cast<double>(results.size());
      sum.num_walks += results[i].num_walks;
      sum.num_falls += results[i].num_falls;
    }
    search.tell(costs);
    std::printf("generation %d: mean cost %.4f, best %.4f; %d falls in %d walks; sigma %.3f\n",
                generation, sum.cost, *std::min_element(costs.begin(), costs.end()), sum.num_falls,
                sum.num_walks, search.sigma());
    std::fflush(stdout);
    write_text(options.search.output,
               with_gait_values(text, space.gait(search.mean()), parameters));
  }
}

void tune(const TunerOptions& options) {
  const std::filesystem::path folder = data_path() / "robots" / options.search.model;
  const std::filesystem::path file =
      options.gait_file.empty() ? folder / "gait.yaml" : std::filesystem::path(options.gait_file);
  const auto model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  std::vector<Gait::Parameter> parameters;
  Gait gait = Gait::load(file, &parameters);
  apply(options.settings, parameters, gait);
  const WalkCourse course(model, SceneFile::find("empty"), options.speed, options.late_probability);
  if (!options.is_check) {
    search(options, course, gait, parameters, read_text(file));
    return;
  }
  const CourseResult result = evaluate(course, {gait}, options, kCheckSeed).front();
  std::printf("cost %.4f, %d falls in %d walks\n", result.cost, result.num_falls, result.num_walks);
}

}  // namespace
}  // namespace nao::tool

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Tunes a robot's gait in simulation. A seeded search (CMA-ES) varies the parameters of the "
      "gait file within their ranges. Each candidate is evaluated by walks with noise, latency and "
      "pushes. The result is written after every generation; equal seeds give equal results.",
      "nao-walk-tuner");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  nao::tool::TunerOptions options;
  nao::add_search_options(app, options.search, "gait", "fraction of the parameters' ranges");
  app.add_option("--gait", options.gait_file, "Gait file to start from (default: the robot's)");
  app.add_option("--set", options.settings, "GROUP.KEY=NUMBER in place of the file's value");
  app.add_option("--only", options.only,
                 "Parameters to tune, GROUP.KEY (default: all but limits, arms and kick)");
  app.add_option("--courses", options.courses, "Courses of ten walks for each candidate")
      ->positive()
      ->show_default();
  app.add_option("--speed", options.speed, "Commanded fraction of the robot's walk limits")
      ->positive()
      ->show_default();
  app.add_option("--late", options.late_probability,
                 "Probability that the motion core misses a tick and up to three more")
      ->range(0.0, 1.0)
      ->show_default();
  app.add_flag("--check", options.is_check, "Only evaluate the gait, on --courses courses");
  return nao::run_program(app, common, argc, argv, [&] { nao::tool::tune(options); });
}
