#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <list>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace nao::gateway {

/** Limits the connections that have not sent Connect (or, over HTTP, a request) yet. One connection
 * too many closes the oldest one of the address that has most of them, so that half-open
 * connections of one host do not keep other hosts out. */
class HandshakeLimiter {
 private:
  struct Handshake {
    std::string address;
    std::function<void()> evict;
    bool is_evicted = false;
  };

 public:
  /** A connection in the limiter. */
  using Entry = std::list<Handshake>::iterator;

  explicit HandshakeLimiter(size_t max_handshakes) : max_handshakes_(max_handshakes) {}

  /** Adds a connection.
   * @param evict  Closes the connection, which then removes itself, within the call or later.
   * @param entry  Set to the connection's entry.
   * @return true if another connection was evicted for it. */
  bool add(const std::string& address, std::function<void()> evict, Entry& entry) {
    handshakes_.push_back({address, std::move(evict), false});
    entry = std::prev(handshakes_.end());
    if (size() <= max_handshakes_) return false;
    const std::string busiest = find_busiest_address();
    const Entry oldest =
        std::find_if(handshakes_.begin(), handshakes_.end(), [&](const Handshake& handshake) {
          return !handshake.is_evicted && handshake.address == busiest;
        });
    oldest->is_evicted = true;
    ++num_evicted_;
    // A copy: the connection may remove its entry, and the function with it, during the call.
    const std::function<void()> evict_oldest = oldest->evict;
    evict_oldest();
    return true;
  }

  /** Removes a connection: its handshake has ended, or it has closed. */
  void remove(Entry entry) {
    if (entry->is_evicted) --num_evicted_;
    handshakes_.erase(entry);
  }

  /** Connections that have not been evicted. */
  size_t size() const { return handshakes_.size() - num_evicted_; }

 private:
  /** The address with most connections that have not been evicted; there is at least one. */
  std::string find_busiest_address() const {
    std::map<std::string_view, int> counts;
    for (const Handshake& handshake : handshakes_) {
      counts[handshake.address] += handshake.is_evicted ? 0 : 1;
    }
    const auto busiest =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return std::string(busiest->first);
  }

  size_t max_handshakes_;
  std::list<Handshake> handshakes_;
  size_t num_evicted_ = 0;
};

}  // namespace nao::gateway
