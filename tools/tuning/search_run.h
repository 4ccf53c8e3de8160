#pragma once

#include "tools/tuning/evaluator.h"
#include "tools/tuning/search_options.h"
#include "tools/tuning/tuning_problem.h"

namespace nao {

/** Searches by CMA-ES, generation by generation: all candidates of a generation in the same trials,
 * each generation in new ones. After each generation it replaces the output and the checkpoint, and
 * prints a line.
 *
 * Output and checkpoint depend on options and problem only: not on the evaluator, nor on whether
 * the search was interrupted and resumed. SIGINT or SIGUSR1 ends it after the present generation; a
 * second SIGINT at once.
 * @throws ConfigError  if the checkpoint to resume from is damaged or belongs to another search.
 * @throws Error        if a file cannot be read or written, or a trial fails. */
void run_search(const SearchOptions& options, const TuningProblem& problem, Evaluator& evaluator);

/** Evaluates the start of the search, in trials that no search uses, and prints a line. */
void run_check(const TuningProblem& problem, Evaluator& evaluator);

/** Runs the search, or only its check, on all workers that the options name. Throws as run_search
 * and with_workers. */
void run_on_workers(const SearchOptions& options, const TuningProblem& problem, bool is_check);

}  // namespace nao
