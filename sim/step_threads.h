#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace nao::sim {

/** Threads that share the work of a tick, which takes some 10 us a robot: between two ticks that
 * follow each other at once they look for work without going to sleep. The calling thread is one
 * of them, and takes everything that the others do not take in time. */
class StepThreads {
 public:
  /** Bytes that cores exchange together: two cache lines of x86-64. */
  static constexpr size_t kLine = 128;

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
  /** The items of a thread, i = thread, thread + threads, ...: the first one that nobody took in
   * the low 32 bits, the end of all items above. */
  struct alignas(kLine) Share {
    std::atomic<uint64_t> next_and_end{0};
  };

  void run(int count, Call call, void* context);
  /** Takes items that nobody took: first a thread's own, so that an item's data stay in the cache
   * of one core from step to step; then those of threads that are late. */
  void take_items(size_t thread);
  void work(size_t thread);

  std::vector<Share> shares_;
  alignas(kLine) Call call_ = nullptr;
  void* context_ = nullptr;
  /** Items that are not done yet. */
  alignas(kLine) std::atomic<int> num_open_{0};
  /** Rises with every run(), and at the end. */
  alignas(kLine) std::atomic<unsigned> round_{0};
  std::atomic<bool> is_ending_{false};
  std::vector<std::jthread> threads_;
};

}  // namespace nao::sim
