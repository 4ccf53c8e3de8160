#pragma once

#include <string>
#include <vector>

#include "tools/tuning/evaluator.h"

namespace nao {

/** Runs tasks in all processes that mpirun started, by Open MPI.
 *
 * Every process makes one, with the same options. The first process (rank 0) searches and runs
 * tasks like the others; the others serve(). The thread that makes it is the only one that calls
 * MPI; the tasks run on other threads. It asks every millisecond for messages instead of waiting
 * for them, since Open MPI waits in a busy loop. */
class MpiEvaluator : public Evaluator {
 public:
  /** Begins MPI, which a process can do once.
   * @param num_threads  Number of threads of this process.
   * @param identity  Text about everything that the tasks' results depend on.
   * @throws Error  in the first process if another one has another identity. */
  MpiEvaluator(int num_threads, const std::string& identity, RunTask run);
  /** Ends the other processes' serve(), and MPI. */
  ~MpiEvaluator() override;
  MpiEvaluator(const MpiEvaluator&) = delete;
  MpiEvaluator& operator=(const MpiEvaluator&) = delete;

  bool is_first() const { return rank_ == 0; }
  /** In a process other than the first: runs its tasks until that one ends. */
  void serve();

  int num_workers() const override;
  /** In the first process only. */
  std::vector<Outcome> evaluate(const std::vector<Task>& tasks) override;

 private:
  void gather_slots(const std::string& identity);
  void end_processes();

  WorkerThreads threads_;
  int rank_ = 0;
  int num_processes_ = 1;
  /** In the first process: threads of each process. */
  std::vector<int> slots_;
};

}  // namespace nao
