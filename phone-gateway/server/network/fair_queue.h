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

/** Serves items in order after the handler that adds them, for a limited time in each iteration of
 * the event loop: events that have become ready in the meantime are handled between two items. */
template <class Item>
class FairQueue {
 public:
  /** @param io  Must outlive this, or at least run nothing after the end of this.
   * @param slice  Time of one iteration, after which no item is served; 0: one item in each.
   * @param serve  Called once for each item. */
  FairQueue(boost::asio::io_context& io, std::chrono::microseconds slice,
            std::function<void(const Item&)> serve)
      : io_(io), slice_(slice), serve_(std::move(serve)) {}

  void add(Item item) {
    items_.push_back(std::move(item));
    if (items_.size() == 1) post();
  }

 private:
  void post() {
    boost::asio::post(io_, [this] {
      const auto end = std::chrono::steady_clock::now() + slice_;
      do {
        const Item item = std::move(items_.front());
        serve_(item);
        // Removed only afterwards, so that an item that adds another one does not post twice.
        items_.pop_front();
      } while (!items_.empty() && std::chrono::steady_clock::now() < end);
      if (!items_.empty()) post();
    });
  }

  boost::asio::io_context& io_;
  std::chrono::microseconds slice_;
  std::function<void(const Item&)> serve_;
  std::deque<Item> items_;
};

}  // namespace nao::gateway
