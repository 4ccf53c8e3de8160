#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <deque>
#include <functional>

namespace nao::gateway {

/** Executes tasks in order after the handler that adds them, for a limited time in each iteration
 * of the event loop: events that have become ready in the meantime are handled between two tasks.
 */
class FairQueue {
 public:
  /** @param io  Must outlive this, or at least run nothing after the end of this.
   * @param slice  Time of one iteration, after which no task begins; 0: one task in each. */
  FairQueue(boost::asio::io_context& io, std::chrono::microseconds slice)
      : io_(io), slice_(slice) {}

  void add(std::function<void()> task) {
    tasks_.push_back(std::move(task));
    if (tasks_.size() == 1) post();
  }

 private:
  void post() {
    boost::asio::post(io_, [this] {
      const auto end = std::chrono::steady_clock::now() + slice_;
      do {
        const std::function<void()> task = std::move(tasks_.front());
        task();
        // Removed only after the task, so that a task that adds another one does not post twice.
        tasks_.pop_front();
      } while (!tasks_.empty() && std::chrono::steady_clock::now() < end);
      if (!tasks_.empty()) post();
    });
  }

  boost::asio::io_context& io_;
  std::chrono::microseconds slice_;
  std::deque<std::function<void()>> tasks_;
};

}  // namespace nao::gateway
