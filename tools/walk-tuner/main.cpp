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

namespace nao {
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
  double late_share = 0.01;
  bool is_check = false;
};

// Bounds, habits and looks: a search by these walks would only misuse them.
const std::vector<std::string> kNotTuned = {
    "start_duration",     "stop_duration",       "max_step_forward",   "max_step_backward",
    "max_step_outward",   "min_foot_separation", "max_turn_outward",   "max_turn_inward",
    "max_change_forward", "max_change_sideways", "max_change_turning", "envelope_exponent",
    "shoulder_pitch",     "shoulder_roll",       "elbow_yaw",          "elbow_roll",
    "turn_centre",        "raise_duration",      "kick_distance",      "kick_reach",
    "kick_lift"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** Between a gait and a point in the unit cube of the tuned parameters' ranges. */
class GaitSpace {
 public:
  GaitSpace(Gait base, std::vector<Gait::Parameter> parameters)
      : base_(base), parameters_(std::move(parameters)) {}

  Eigen::VectorXd point() const {
    Eigen::VectorXd point(parameters_.size());
    for (size_t i = 0; i < parameters_.size(); ++i) {
      const Gait::Parameter& p = parameters_[i];
      point[static_cast<long>(i)] = (base_.*p.member - p.lower) / (p.upper - p.lower);
    }
    return point;
  }
  /** Coordinates outside the cube count as on its edge. */
  Gait gait(const Eigen::VectorXd& point) const {
    Gait gait = base_;
    for (size_t i = 0; i < parameters_.size(); ++i) {
      const Gait::Parameter& p = parameters_[i];
      gait.*p.member =
          p.lower + std::clamp(point[static_cast<long>(i)], 0.0, 1.0) * (p.upper - p.lower);
    }
    return gait;
  }
  const std::vector<Gait::Parameter>& parameters() const { return parameters_; }

 private:
  Gait base_;
  std::vector<Gait::Parameter> parameters_;
};

/** Applies "key=value" settings. @throws ConfigError */
void apply(const std::vector<std::string>& settings, const std::vector<Gait::Parameter>& parameters,
           Gait& gait) {
  for (const std::string& setting : settings) {
    const size_t at = setting.find('=');
    const auto found = std::find_if(
        parameters.begin(), parameters.end(),
        [&](const Gait::Parameter& parameter) { return setting.substr(0, at) == parameter.key; });
    char* end = nullptr;
    const double value = at == std::string::npos ? 0 : std::strtod(setting.c_str() + at + 1, &end);
    if (found == parameters.end() || end == nullptr || *end != 0) {
      throw ConfigError("--set wants KEY=NUMBER with a key of the gait file, not " + setting);
    }
    gait.*found->member = value;
  }
}

/** Every candidate on every course, on several cores; the answer does not depend on how many. */
std::vector<CourseResult> judge(const WalkCourse& course, const std::vector<Gait>& gaits,
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

void tune(const TunerOptions& options) {
  const std::filesystem::path folder = data_path() / "robots" / options.search.model;
  const std::filesystem::path file =
      options.gait_file.empty() ? folder / "gait.yaml" : std::filesystem::path(options.gait_file);
  const auto model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  std::vector<Gait::Parameter> parameters;
  Gait gait = Gait::load(file, &parameters);
  apply(options.settings, parameters, gait);
  const WalkCourse course(model, SceneFile::find("empty"), options.speed, options.late_share);

  if (options.is_check) {
    const CourseResult result = judge(course, {gait}, options, 1000000).front();
    std::printf("cost %.4f, %d falls in %d walks\n", result.cost, result.num_falls,
                result.num_walks);
    return;
  }
  std::vector<Gait::Parameter> tuned;
  for (const Gait::Parameter& parameter : parameters) {
    const bool is_tuned = options.only.empty() ? !contains(kNotTuned, parameter.key)
                                               : contains(options.only, parameter.key);
    if (is_tuned) tuned.push_back(parameter);
  }
  if (tuned.size() < 2) throw ConfigError("--only must name two parameters of the gait at least");
  const GaitSpace space(gait, tuned);
  const std::string text = read_text(file);
  CmaEs search(space.point(), options.search.sigma, options.search.population, options.search.seed);
  for (int generation = 1; generation <= options.search.generations; ++generation) {
    const std::vector<Eigen::VectorXd> candidates = search.ask();
    std::vector<Gait> gaits;
    for (const Eigen::VectorXd& candidate : candidates) gaits.push_back(space.gait(candidate));
    const auto courses = static_cast<uint64_t>(options.courses);
    const uint64_t first_seed =
        options.search.seed * 10000 + static_cast<uint64_t>(generation) * courses;
    const std::vector<CourseResult> results = judge(course, gaits, options, first_seed);
    std::vector<double> costs;
    CourseResult sum;
    for (size_t i = 0; i < results.size(); ++i) {
      const Eigen::VectorXd inside = candidates[i].cwiseMax(0).cwiseMin(1);
      costs.push_back(results[i].cost + 10 * (candidates[i] - inside).squaredNorm());
      sum.cost += results[i].cost / static_cast<double>(results.size());
      sum.num_walks += results[i].num_walks;
      sum.num_falls += results[i].num_falls;
    }
    search.tell(costs);
    std::printf("generation %d: cost %.4f mean, %.4f best; %d falls in %d walks; spread %.3f\n",
                generation, sum.cost, *std::min_element(costs.begin(), costs.end()), sum.num_falls,
                sum.num_walks, search.sigma());
    std::fflush(stdout);
    write_text(options.search.output,
               with_gait_values(text, space.gait(search.mean()), parameters));
  }
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Tunes a robot's gait: a seeded search over its parameters, each within the range that the "
      "gait file gives, judged by walks in physics with noise, latency and pushes. Writes the gait "
      "file anew after every generation; the same seed gives the same search.",
      "nao-walk-tuner");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  nao::TunerOptions options;
  nao::add_search_options(app, options.search, "gait", "share of the parameters' ranges");
  app.add_option("--gait", options.gait_file, "Gait file to start from (default: the robot's)");
  app.add_option("--set", options.settings, "KEY=NUMBER instead of the file's value");
  app.add_option("--only", options.only, "Parameters to tune (default: all but bounds and looks)");
  app.add_option("--courses", options.courses, "Courses of ten walks for each candidate")
      ->positive()
      ->show_default();
  app.add_option("--speed", options.speed, "Share of the robot's walk limits to ask for")
      ->positive()
      ->show_default();
  app.add_option("--late", options.late_share,
                 "Chance in each tick that motion misses it and up to three more")
      ->show_default();
  app.add_flag("--check", options.is_check, "Only judge the gait, by --courses courses");
  return nao::run_program(app, common, argc, argv, [&] { nao::tune(options); });
}
