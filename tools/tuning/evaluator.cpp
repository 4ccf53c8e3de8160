#include "tools/tuning/evaluator.h"

#include "tools/tuning/task_batch.h"

namespace nao {

std::vector<Outcome> ThreadEvaluator::evaluate(const std::vector<Task>& tasks) {
  // One worker process: rank 0 with all threads.
  TaskBatch batch(tasks.size(), {threads_.count()});
  while (!batch.is_done()) {
    while (const auto index = batch.assign(0)) threads_.submit({*index, tasks[*index]});
    batch.finish(0, threads_.wait());
  }
  return batch.take();
}

}  // namespace nao
