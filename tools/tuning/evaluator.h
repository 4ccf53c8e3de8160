#pragma once

#include <vector>

#include "tools/tuning/task.h"
#include "tools/tuning/worker_threads.h"

namespace nao {

/** Runs batches of tasks on all of its workers. */
class Evaluator {
 public:
  virtual ~Evaluator() = default;

  /** Tasks that run at a time. */
  virtual int num_workers() const = 0;
  /** @return Outcomes in the order of the tasks.
   * @throws Error  if one of the tasks failed. */
  virtual std::vector<Outcome> evaluate(const std::vector<Task>& tasks) = 0;
};

/** Runs tasks on threads of this process. */
class ThreadEvaluator : public Evaluator {
 public:
  ThreadEvaluator(int num_threads, RunTask run) : threads_(num_threads, std::move(run)) {}

  int num_workers() const override { return threads_.count(); }
  std::vector<Outcome> evaluate(const std::vector<Task>& tasks) override;

 private:
  WorkerThreads threads_;
};

}  // namespace nao
