#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tools/tuning/evaluator.h"
#include "tools/tuning/tuning_problem.h"

namespace nao {

/** Candidates that were evaluated in the same trials. */
struct EvaluatedGeneration {
  std::vector<double> costs;
  /** Figures of all trials that were run. */
  std::vector<Figures> trials;
  /** Sum and maximum of the trials' processor times, s. */
  double total_time = 0;
  double longest_time = 0;
};

/** Runs all trials of all candidates.
 *
 * With `screen` above 0 and below the number of trials, the worst third of the candidates after
 * that many trials is dropped: these get costs above every other candidate, in the order of the
 * costs of their few trials. CMA-ES learns from the better half only.
 * @throws Error  if a trial fails, or a cost is not finite. */
EvaluatedGeneration evaluate_generation(const TuningProblem& problem, Evaluator& evaluator,
                                        const std::vector<Eigen::VectorXd>& candidates,
                                        uint64_t first_seed, int screen);

}  // namespace nao
