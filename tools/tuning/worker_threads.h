#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "tools/tuning/task.h"
#include "tools/tuning/task_codec.h"

namespace nao {

/** Threads that run tasks in the order of submission. An exception of a task becomes its outcome's
 * error. */
class WorkerThreads {
 public:
  WorkerThreads(int count, RunTask run);
  /** Waits for the running tasks; those that have not begun are dropped. */
  ~WorkerThreads();
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  int count() const { return static_cast<int>(threads_.size()); }
  void submit(IndexedTask task);
  /** Outcome of a finished task, each once; none if there is none at present. */
  std::optional<Outcome> poll();
  /** Waits for the outcome of one of the submitted tasks. */
  Outcome wait();

 private:
  void work();

  RunTask run_;
  std::mutex mutex_;
  /** Notified when a task is submitted, the destructor runs, or an outcome is there. */
  std::condition_variable changed_;
  std::deque<IndexedTask> tasks_;
  std::deque<Outcome> outcomes_;
  bool is_ending_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace nao
