#include "tools/tuning/search_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <numeric>
#include <ratio>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/output_file.h"
#include "common/text_file.h"
#include "tools/tuning/checkpoint.h"
#include "tools/tuning/cma_es.h"
#include "tools/tuning/generation.h"
#include "tools/tuning/stop_signal.h"
#include "tools/tuning/workers.h"

namespace nao {
namespace {

using Clock = std::chrono::steady_clock;

// Seeds between the first seeds of two searches whose --seed differs by 1. Chosen: more than a
// search uses.
constexpr uint64_t kSeedsPerSearch = 10'000'000;
// First seed of run_check(): below those of all searches with --seed 1 and above, and above those
// of nao-trial's usual ranges.
constexpr uint64_t kCheckSeed = 1'000'000;

std::vector<double> to_list(const Eigen::VectorXd& vector) {
  return {vector.begin(), vector.end()};
}

std::map<std::string, std::string> settings_of(const SearchOptions& options,
                                               const TuningProblem& problem) {
  std::map<std::string, std::string> settings = problem.settings();
  settings.merge(options.settings());
  return settings;
}

Checkpoint read_checkpoint(const std::string& file,
                           const std::map<std::string, std::string>& settings) {
  const std::string text = read_file(file);
  Checkpoint checkpoint;
  try {
    checkpoint = Checkpoint::parse(text, file);
  } catch (const ConfigError& error) {
    throw ConfigError(
        fmt::format("{}: the checkpoint is damaged; begin again without --resume", error.what()));
  }
  checkpoint.require_settings(settings, file);
  return checkpoint;
}

/** Brings a new search to the state of the checkpoint. */
// CMA-ES is deterministic: asking and telling the stored costs again gives the same state, without
// storing the covariance.
void replay(const Checkpoint& checkpoint, int population, const std::string& file, CmaEs& search) {
  for (const std::vector<double>& costs : checkpoint.costs) {
    if (costs.size() != static_cast<size_t>(population)) {
      throw ConfigError(fmt::format(
          "{} has {} costs in a generation of {} candidates: the checkpoint is damaged; begin "
          "again without --resume",
          file, costs.size(), population));
    }
    search.ask();
    search.tell(costs);
  }
  // The stored mean is the check that the build computes the same numbers bit by bit.
  if (to_list(search.mean()) != checkpoint.mean) {
    throw ConfigError(
        fmt::format("the costs in {} do not lead to its mean: the checkpoint is damaged, or of "
                    "another build of this program; begin again without --resume",
                    file));
  }
}

void print_generation(const SearchOptions& options, const TuningProblem& problem, int generation,
                      const EvaluatedGeneration& evaluated, double sigma, double wall_time,
                      int num_workers) {
  const double sum = std::accumulate(evaluated.costs.begin(), evaluated.costs.end(), 0.0);
  fmt::print(
      "generation {} of {}: cost {:.4f} mean, {:.4f} best; {}; sigma {:.4f}; {} trials in {:.1f} "
      "s, {:.1f} s of processor time on {} workers, the longest {:.2f} s\n",
      generation, options.generations, sum / static_cast<double>(evaluated.costs.size()),
      *std::min_element(evaluated.costs.begin(), evaluated.costs.end()),
      problem.describe(evaluated.trials), sigma, evaluated.trials.size(), wall_time,
      evaluated.total_time, num_workers, evaluated.longest_time);
  std::fflush(stdout);
}

/** Text about everything that the results of the problem's trials depend on. */
std::string identity_of(const SearchOptions& options, const TuningProblem& problem) {
  std::string text;
  for (const auto& [name, value] : settings_of(options, problem)) {
    text += fmt::format("{}={}\n", name, value);
  }
  return text;
}

}  // namespace

void run_search(const SearchOptions& options, const TuningProblem& problem, Evaluator& evaluator) {
  CmaEs search(problem.start(), options.sigma, options.population, options.seed);
  Checkpoint checkpoint;
  checkpoint.settings = settings_of(options, problem);
  if (!options.resume.empty()) {
    checkpoint = read_checkpoint(options.resume, checkpoint.settings);
    replay(checkpoint, options.population, options.resume, search);
  }
  const StopSignal stop;
  const auto first = static_cast<int>(checkpoint.costs.size()) + 1;
  const Clock::time_point search_begin = Clock::now();
  const auto is_time_over = [&] {
    const std::chrono::duration<double, std::ratio<60>> time = Clock::now() - search_begin;
    return options.minutes > 0 && time.count() >= options.minutes;
  };
  for (int generation = first;
       generation <= options.generations && !stop.has_come() && !is_time_over(); ++generation) {
    const Clock::time_point begin = Clock::now();
    const std::vector<Eigen::VectorXd> candidates = search.ask();
    // New seeds in each generation, so that the search does not adapt to a few of them.
    const uint64_t first_seed =
        options.seed * kSeedsPerSearch +
        static_cast<uint64_t>(generation) * static_cast<uint64_t>(problem.num_seeds());
    const EvaluatedGeneration evaluated =
        evaluate_generation(problem, evaluator, candidates, first_seed, options.screen);
    search.tell(evaluated.costs);
    checkpoint.costs.push_back(evaluated.costs);
    checkpoint.mean = to_list(search.mean());
    replace_file(options.output, problem.text(search.mean()));
    replace_file(options.checkpoint_file(), checkpoint.to_text());
    const std::chrono::duration<double> wall_time = Clock::now() - begin;
    print_generation(options, problem, generation, evaluated, search.sigma(), wall_time.count(),
                     evaluator.num_workers());
  }
  if (stop.has_come()) {
    fmt::print("interrupted after generation {}: continue with --resume {}\n",
               checkpoint.costs.size(), options.checkpoint_file());
  }
  // A resumed search may have nothing left to do, and another output.
  replace_file(options.output, problem.text(search.mean()));
}

void run_check(const TuningProblem& problem, Evaluator& evaluator) {
  const Eigen::VectorXd start = problem.start();
  const EvaluatedGeneration evaluated =
      evaluate_generation(problem, evaluator, {start}, kCheckSeed, 0);
  fmt::print("cost {:.4f}; {}\n", evaluated.costs.front(), problem.describe(evaluated.trials));
}

void run_on_workers(const SearchOptions& options, const TuningProblem& problem, bool is_check) {
  with_workers(
      options.jobs, identity_of(options, problem),
      [&](const Task& task) { return problem.run(task); },
      [&](Evaluator& evaluator) {
        if (is_check) return run_check(problem, evaluator);
        run_search(options, problem, evaluator);
      });
}

}  // namespace nao
