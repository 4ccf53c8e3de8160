#include "tools/tuning/worker_threads.h"

#include <exception>
#include <utility>

#include "common/processor_time.h"

namespace nao {
namespace {

Outcome run_one(const RunTask& run, const IndexedTask& task) {
  Outcome outcome;
  outcome.index = task.index;
  const double start = thread_seconds();
  try {
    outcome.figures = run(task.task);
  } catch (const std::exception& exception) {
    outcome.error = exception.what();
    if (outcome.error.empty()) outcome.error = "a trial has failed";
  }
  outcome.duration = thread_seconds() - start;
  return outcome;
}

}  // namespace

WorkerThreads::WorkerThreads(int count, RunTask run) : run_(std::move(run)) {
  for (int i = 0; i < count; ++i) threads_.emplace_back([this] { work(); });
}

WorkerThreads::~WorkerThreads() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
}

void WorkerThreads::submit(IndexedTask task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
}

std::optional<Outcome> WorkerThreads::poll() {
  const std::lock_guard lock(mutex_);
  if (outcomes_.empty()) return std::nullopt;
  Outcome outcome = std::move(outcomes_.front());
  outcomes_.pop_front();
  return outcome;
}

Outcome WorkerThreads::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !outcomes_.empty(); });
  Outcome outcome = std::move(outcomes_.front());
  outcomes_.pop_front();
  return outcome;
}

void WorkerThreads::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_ending_ || !tasks_.empty(); });
    if (is_ending_) return;
    const IndexedTask task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    Outcome outcome = run_one(run_, task);
    lock.lock();
    outcomes_.push_back(std::move(outcome));
    lock.unlock();
    changed_.notify_all();
  }
}

}  // namespace nao
