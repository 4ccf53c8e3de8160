#include "tools/tuning/search_run.h"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
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
#include "tools/tuning/workers.h"

namespace nao {
namespace {

/** While one exists, SIGINT and SIGUSR1 (which mpirun passes on to its processes) set a flag
 * instead of ending the process; a second SIGINT ends it. */
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  bool has_come() const;

 private:
  struct sigaction old_interrupt_ = {};
  struct sigaction old_user_ = {};
};

volatile std::sig_atomic_t signal_has_come = 0;

StopSignal::StopSignal() {
  signal_has_come = 0;
  struct sigaction action = {};
  action.sa_handler = [](int) { signal_has_come = 1; };
  // The handler acts once: the next signal has its usual effect. Interrupted system calls are
  // restarted.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGUSR1, &action, &old_user_);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGUSR1, &old_user_, nullptr);
}

bool StopSignal::has_come() const {
  return signal_has_come != 0;
}

/** Candidates that were evaluated in the same trials. */
struct EvaluatedGeneration {
  std::vector<double> costs;
  /** Figures of all trials that were run. */
  std::vector<Figures> trials;
  /** Sum and maximum of the trials' processor times, s. */
  double total_time = 0;
  double longest_time = 0;
};

/** Runs trials [begin, end) of the chosen candidates, and adds their figures to `trials` of each.
 */
void run_trials(Evaluator& evaluator, const std::vector<Eigen::VectorXd>& candidates,
                const std::vector<size_t>& chosen, uint64_t first_seed, int begin, int end,
                std::vector<std::vector<Figures>>& trials, EvaluatedGeneration& result) {
  std::vector<Task> tasks;
  for (size_t k : chosen) {
    const std::vector<double> point(candidates[k].begin(), candidates[k].end());
    for (int trial = begin; trial < end; ++trial) tasks.push_back({point, first_seed, trial});
  }
  const std::vector<Outcome> outcomes = evaluator.evaluate(tasks);
  // Outcomes come in the order of tasks: num_each of each chosen candidate.
  const auto num_each = static_cast<size_t>(end - begin);
  for (size_t i = 0; i < outcomes.size(); ++i) {
    trials[chosen[i / num_each]].push_back(outcomes[i].figures);
    result.trials.push_back(outcomes[i].figures);
    result.total_time += outcomes[i].duration;
    result.longest_time = std::max(result.longest_time, outcomes[i].duration);
  }
}

/** Runs all trials of all candidates.
 *
 * With `screen` above 0 and below the number of trials, the worst third of the candidates after
 * that many trials is dropped: these get costs above every other candidate, in the order of the
 * costs of their few trials. CMA-ES learns from the better half only.
 * @throws Error  if a trial fails, or a cost is not finite. */
EvaluatedGeneration evaluate_generation(const TuningProblem& problem, Evaluator& evaluator,
                                        const std::vector<Eigen::VectorXd>& candidates,
                                        uint64_t first_seed, int screen) {
  EvaluatedGeneration result;
  const size_t num_candidates = candidates.size();
  std::vector<std::vector<Figures>> trials(num_candidates);
  std::vector<size_t> chosen(num_candidates);
  std::iota(chosen.begin(), chosen.end(), size_t{0});
  const auto cost_of = [&](size_t k) {
    const double cost = problem.cost(candidates[k], trials[k]);
    // An infinite or NaN cost would make the ranking meaningless.
    if (!std::isfinite(cost)) throw Error(fmt::format("cost {} of a candidate", cost));
    return cost;
  };

  // Screening: all candidates run some trials; the worst third of them is dropped, and the others
  // run the rest.
  const int num_trials = problem.num_trials();
  const bool is_screened = screen > 0 && screen < num_trials;
  const int first_end = is_screened ? screen : num_trials;
  run_trials(evaluator, candidates, chosen, first_seed, 0, first_end, trials, result);
  for (size_t k = 0; k < num_candidates; ++k) result.costs.push_back(cost_of(k));
  if (!is_screened) return result;

  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](size_t a, size_t b) { return result.costs[a] < result.costs[b]; });
  const size_t num_kept = num_candidates - num_candidates / 3;
  const std::vector<size_t> given_up(chosen.begin() + static_cast<long>(num_kept), chosen.end());
  chosen.resize(num_kept);
  // In the candidates' order again, so that seeds and tasks do not depend on the ranking.
  std::sort(chosen.begin(), chosen.end());
  run_trials(evaluator, candidates, chosen, first_seed, first_end, num_trials, trials, result);
  double worst = -std::numeric_limits<double>::infinity();
  for (size_t k : chosen) {
    result.costs[k] = cost_of(k);
    worst = std::max(worst, result.costs[k]);
  }
  // Above every cost of all trials, in the order of the few: 1 apart, as costs have no common unit.
  double rank = 1;
  for (size_t k : given_up) result.costs[k] = worst + rank++;
  return result;
}

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
