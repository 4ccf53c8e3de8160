#pragma once

#include <optional>
#include <vector>

#include "tools/tuning/task.h"

namespace nao {

/** Distributes the tasks of a batch among workers, and orders the results.
 *
 * Workers differ in speed: each gets its next task when it has finished one. The results are in the
 * order of the tasks, independent of the workers that ran them and the order in which they ended.
 * No clock, thread or connection: those belong to the evaluators. */
class TaskBatch {
 public:
  /** @param slots  Tasks that each worker runs at a time; at least one worker must have a slot. */
  TaskBatch(size_t num_tasks, std::vector<int> slots);

  /** Index of the task that a worker must run next; none if all of its slots are taken or no task
   * is left. */
  std::optional<size_t> assign(size_t worker);
  /** @throws Error  if that worker does not run that task. */
  void finish(size_t worker, Outcome outcome);
  bool is_done() const { return num_finished_ == outcomes_.size(); }

  /** Takes the outcomes of the finished batch, in the order of the tasks.
   * @throws Error  with the text of the first task, in their order, that has failed. */
  std::vector<Outcome> take();

 private:
  std::vector<int> free_slots_;
  size_t next_ = 0;
  size_t num_finished_ = 0;
  /** Worker that runs each task; -1: none yet, or it is finished. */
  std::vector<int> runs_on_;
  std::vector<Outcome> outcomes_;
};

}  // namespace nao
