#pragma once

#include <functional>
#include <string>

#include "tools/tuning/evaluator.h"

namespace nao {

/** Makes the workers of this process, and in the process that searches calls `search` with an
 * evaluator on all of them.
 *
 * Started by mpirun, the workers are the threads of all processes; the first process searches, and
 * in the others this returns when that has ended. Otherwise they are threads of this process.
 *
 * @param num_threads  In this process; 0: one for each core that it may use, or one in a process
 * that mpirun started.
 * @param identity  Text about everything that the results of `run` depend on.
 * @throws Error  if mpirun started several processes and this build has no Open MPI, or if they
 * have different identities; and what `search` throws. */
void with_workers(int num_threads, const std::string& identity, const RunTask& run,
                  const std::function<void(Evaluator&)>& search);

}  // namespace nao
