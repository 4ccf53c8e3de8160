#include "tools/tuning/workers.h"

#include <sched.h>

#include <algorithm>
#include <cstdlib>

#include "common/error.h"
#ifdef NAO_HAS_MPI
#include "tools/tuning/mpi_evaluator.h"
#endif

namespace nao {
namespace {

/** Processes that mpirun started, this one included; 0 without mpirun. Open MPI sets the variable
 * for each of them. */
int num_mpi_processes() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size != nullptr ? std::atoi(size) : 0;
}

/** Cores that this process may use: std::thread::hardware_concurrency() counts all of the machine.
 */
int num_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof(cores), &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
}

}  // namespace

void with_workers(int num_threads, const std::string& identity, const RunTask& run,
                  const std::function<void(Evaluator&)>& search) {
  const int num_processes = num_mpi_processes();
  if (num_threads == 0) num_threads = num_processes > 0 ? 1 : num_cores();
#ifdef NAO_HAS_MPI
  if (num_processes > 0) {
    MpiEvaluator evaluator(num_threads, identity, run);
    if (evaluator.is_first()) {
      search(evaluator);
    } else {
      evaluator.serve();
    }
    return;
  }
#else
  (void)identity;
  if (num_processes > 1) {
    throw Error(
        "this build cannot share its work with other processes of mpirun: install libopenmpi-dev "
        "and build again, or start it without mpirun");
  }
#endif
  ThreadEvaluator evaluator(num_threads, run);
  search(evaluator);
}

}  // namespace nao
