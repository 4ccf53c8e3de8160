#pragma once

// <utility> first: Boost 1.74's coroutine headers rely on it with GCC 12.
#include <utility>
//
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <deque>
#include <functional>

namespace nao {

/** Does tasks one by one, each in a turn of the event loop of its own: whatever has become ready
 * meanwhile comes between them. */
class TurnQueue {
 public:
  /** @param io  Must outlive this, or at least run nothing after its end. */
  explicit TurnQueue(boost::asio::io_context& io) : io_(io) {}

  void add(std::function<void()> task) {
    tasks_.push_back(std::move(task));
    if (tasks_.size() == 1) post();
  }

 private:
  void post() {
    boost::asio::post(io_, [this] {
      const std::function<void()> task = std::move(tasks_.front());
      task();
      // Only now, so that one that adds another does not post twice.
      tasks_.pop_front();
      if (!tasks_.empty()) post();
    });
  }

  boost::asio::io_context& io_;
  std::deque<std::function<void()>> tasks_;
};

}  // namespace nao
