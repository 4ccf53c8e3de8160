#include "tools/tuning/generation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error.h"

namespace nao {
namespace {

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

}  // namespace

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

}  // namespace nao
