#include "tools/tuning/task_batch.h"

#include <fmt/core.h>

#include <utility>

#include "common/error.h"

namespace nao {

TaskBatch::TaskBatch(size_t num_tasks, std::vector<int> slots)
    : free_slots_(std::move(slots)), runs_on_(num_tasks, -1), outcomes_(num_tasks) {}

std::optional<size_t> TaskBatch::assign(size_t worker) {
  if (next_ == outcomes_.size() || free_slots_[worker] == 0) return std::nullopt;
  --free_slots_[worker];
  runs_on_[next_] = static_cast<int>(worker);
  return next_++;
}

void TaskBatch::finish(size_t worker, Outcome outcome) {
  const size_t index = outcome.index;
  if (index >= outcomes_.size() || runs_on_[index] != static_cast<int>(worker)) {
    throw Error(fmt::format("worker {} has sent a result of task {}, which it does not run", worker,
                            index));
  }
  runs_on_[index] = -1;
  outcomes_[index] = std::move(outcome);
  ++free_slots_[worker];
  ++num_finished_;
}

std::vector<Outcome> TaskBatch::take() {
  for (const Outcome& outcome : outcomes_) {
    if (!outcome.error.empty()) throw Error(outcome.error);
  }
  return std::move(outcomes_);
}

}  // namespace nao
