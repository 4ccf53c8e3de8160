#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <deque>
#include <functional>

namespace nao::gateway {

/** Executes tasks in order, one in each iteration of the event loop: events that have become ready
 * in the meantime are handled between two tasks. */
class FairQueue {
 public:
  /** @param io  Must outlive this, or at least run nothing after the end of this. */
  explicit FairQueue(boost::asio::io_context& io) : io_(io) {}

  void add(std::function<void()> task) {
    tasks_.push_back(std::move(task));
    if (tasks_.size() == 1) post();
  }

 private:
  void post() {
    boost::asio::post(io_, [this] {
      const std::function<void()> task = std::move(tasks_.front());
      task();
      // Removed only after the task, so that a task that adds another one does not post twice.
      tasks_.pop_front();
      if (!tasks_.empty()) post();
    });
  }

  boost::asio::io_context& io_;
  std::deque<std::function<void()>> tasks_;
};

}  // namespace nao::gateway
