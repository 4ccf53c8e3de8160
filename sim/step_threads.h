#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace nao::sim {

/** Threads that share the work of a time step, which takes some 10 us: between two steps of a tick
 * they look for work without going to sleep. The calling thread is one of them. */
class StepThreads {
 public:
  /** @param count  Number of threads, including the calling one; 1 or more. */
  explicit StepThreads(int count);
  ~StepThreads();
  StepThreads(const StepThreads&) = delete;
  StepThreads& operator=(const StepThreads&) = delete;

  /** Calls work(i) once for each i from 0 to count - 1, in any order, some at the same time, and
   * returns after all of them. @param work  Does not throw. Allocates nothing. */
  template <class Work>
  void for_each(int count, Work work) {
    const Call call = [](void* context, int i) { (*static_cast<Work*>(context))(i); };
    run(count, call, &work);
  }

 private:
  using Call = void (*)(void*, int);

  void run(int count, Call call, void* context);
  void take_items();
  void work();

  Call call_ = nullptr;
  void* context_ = nullptr;
  int count_ = 0;
  std::atomic<int> next_item_{0};
  std::atomic<int> num_working_{0};
  /** Rises with every run(), and at the end. */
  std::atomic<unsigned> round_{0};
  std::atomic<bool> is_ending_{false};
  std::vector<std::jthread> threads_;
};

}  // namespace nao::sim
