#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/command_line.h"
#include "common/data_path.h"
#include "common/error.h"
#include "common/program.h"
#include "tools/transition-tuner/get_up_course.h"
#include "tools/transition-tuner/transition_text.h"
#include "tools/tuning/cma_es.h"
#include "tools/tuning/search.h"

namespace nao {
namespace {

struct TunerOptions {
  SearchOptions search = {
      .output = "transitions.yaml", .generations = 60, .population = 16, .sigma = 0.04};
  std::string file;
  std::vector<std::string> sequences;
  std::vector<std::string> fixed;
  std::vector<int> keyframes = {0, 1000};
  std::string start = "any";
  int trials = 12;
  bool is_check = false;
};

/** Evaluates every text in every trial on several cores; the result does not depend on their
 * number. */
std::vector<std::vector<GetUpResult>> judge(const RobotModel& model, const GetUpCourse& course,
                                            const std::vector<std::string>& texts,
                                            const TunerOptions& options, uint64_t first_seed) {
  const auto num_trials = static_cast<size_t>(options.trials);
  std::vector<std::vector<GetUpResult>> results(texts.size(), std::vector<GetUpResult>(num_trials));
  for_each_index(texts.size() * num_trials, options.search.jobs, [&](size_t i) {
    const auto graph = motion::TransitionGraph::parse(model, texts[i / num_trials]);
    results[i / num_trials][i % num_trials] = course.run(graph, first_seed + i % num_trials);
  });
  return results;
}

struct Verdict {
  double cost = 0;
  int num_up = 0;
  /** Mean duration of the successful trials, s. */
  double time = 0;
};

Verdict sum_up(const std::vector<GetUpResult>& results) {
  Verdict verdict;
  for (const GetUpResult& result : results) {
    verdict.cost += result.cost / static_cast<double>(results.size());
    verdict.num_up += result.is_up ? 1 : 0;
    verdict.time += result.is_up ? result.time : 0;
  }
  verdict.time /= std::max(1, verdict.num_up);
  return verdict;
}

void check(const RobotModel& model, const GetUpCourse& course, const std::string& text,
           const TunerOptions& options) {
  const auto results = judge(model, course, {text}, options, 1000000).front();
  const Verdict verdict = sum_up(results);
  std::printf("cost %.3f, %d of %d up at the first try, %.2f s\n", verdict.cost, verdict.num_up,
              options.trials, verdict.time);
}

void tune(const TunerOptions& options) {
  const std::filesystem::path folder = data_path() / "robots" / options.search.model;
  const auto model = std::make_shared<const RobotModel>(RobotModel::load(folder));
  const std::string text = read_text(options.file.empty() ? folder / "transitions.yaml"
                                                          : std::filesystem::path(options.file));
  const GetUpCourse course(model, SceneFile::find("empty"), parse_start(options.start));
  if (options.is_check) return check(*model, course, text, options);

  const TransitionText space(*model, text, options.sequences, options.fixed);
  // Only the numbers of the selected keyframes are searched.
  Eigen::VectorXd values(space.parameters().size());
  std::vector<long> chosen;
  for (long i = 0; i < values.size(); ++i) {
    const auto& parameter = space.parameters()[static_cast<size_t>(i)];
    values[i] = parameter.value;
    const bool is_chosen =
        parameter.keyframe >= options.keyframes[0] && parameter.keyframe <= options.keyframes[1];
    if (is_chosen) chosen.push_back(i);
  }
  if (chosen.size() < 2) throw ConfigError("--sequence must name a transition with two numbers");
  const auto text_of = [&](const Eigen::VectorXd& point) {
    values(chosen) = point;
    return space.with(values);
  };
  const auto outside = [&](const Eigen::VectorXd& point) {
    double sum = 0;
    for (size_t k = 0; k < chosen.size(); ++k) {
      const auto& parameter = space.parameters()[static_cast<size_t>(chosen[k])];
      const double value = point[static_cast<long>(k)];
      sum += std::pow(value - std::clamp(value, parameter.lower, parameter.upper), 2);
    }
    return sum;
  };
  const Eigen::VectorXd start = values(chosen);
  CmaEs search(start, options.search.sigma, options.search.population, options.search.seed);
  for (int generation = 1; generation <= options.search.generations; ++generation) {
    const std::vector<Eigen::VectorXd> candidates = search.ask();
    std::vector<std::string> texts;
    for (const Eigen::VectorXd& candidate : candidates) texts.push_back(text_of(candidate));
    const uint64_t first_seed =
        options.search.seed * 100000 +
        static_cast<uint64_t>(generation) * static_cast<uint64_t>(options.trials);
    const auto results = judge(*model, course, texts, options, first_seed);
    std::vector<double> costs;
    Verdict mean;
    for (size_t i = 0; i < results.size(); ++i) {
      const Verdict verdict = sum_up(results[i]);
      costs.push_back(verdict.cost + 10 * outside(candidates[i]));
      mean.cost += verdict.cost / static_cast<double>(results.size());
      mean.num_up += verdict.num_up;
      mean.time += verdict.time / static_cast<double>(results.size());
    }
    search.tell(costs);
    std::printf("generation %d: cost %.3f mean, %.3f best; %d of %zu up, %.2f s; spread %.4f\n",
                generation, mean.cost, *std::min_element(costs.begin(), costs.end()), mean.num_up,
                results.size() * static_cast<size_t>(options.trials), mean.time, search.sigma());
    std::fflush(stdout);
    write_text(options.search.output, text_of(search.mean()));
  }
}

}  // namespace
}  // namespace nao

int main(int argc, char** argv) {
  nao::CommandLine app(
      "Tunes get-up motions: a seeded search over durations and angles of their keyframes, "
      "evaluated "
      "in the simulator with random noise, latency and friction. Rewrites the file of transitions "
      "after every generation; the same seed gives the same search.",
      "nao-transition-tuner");
  nao::CommonOptions common;
  nao::add_common_options(app, common);
  nao::TunerOptions options;
  nao::add_search_options(app, options.search, "transitions", "rad and s");
  app.add_option("--transitions", options.file, "File to start from (default: the robot's)");
  app.add_option("--sequence", options.sequences, "Transitions to tune, by name");
  app.add_option("--keyframes", options.keyframes, "First and last keyframe to tune, from 0")
      ->count(2);
  app.add_option("--fixed", options.fixed, "Joints, without side, whose angles stay")
      ->show_default();
  app.add_option("--start", options.start,
                 "Lying pose at the start: any, belly, back, left or right")
      ->show_default();
  app.add_option("--trials", options.trials, "Trials of each candidate")
      ->positive()
      ->show_default();
  app.add_flag("--check", options.is_check, "Only evaluate the file with --trials trials");
  return nao::run_program(app, common, argc, argv, [&] { nao::tune(options); });
}
