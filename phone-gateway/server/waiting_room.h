#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace nao {

/** Connections that have not said Connect yet. There is room for so many; one more closes the
 * oldest of the address that has most of them, so that a crowd of half-open connections keeps
 * nobody else out. */
class WaitingRoom {
 private:
  struct Guest {
    std::string address;
    std::function<void()> evict;
    bool is_leaving = false;
  };

 public:
  using Place = std::list<Guest>::iterator;

  explicit WaitingRoom(size_t num_places) : num_places_(num_places) {}

  /** @param evict  Closes the connection, which leaves then or some time after.
   * @return true if another connection was closed for it. */
  bool enter(const std::string& address, std::function<void()> evict, Place& place) {
    guests_.push_back({address, std::move(evict), false});
    place = std::prev(guests_.end());
    if (size() <= num_places_) return false;
    const std::string crowd = find_crowd();
    const Place oldest = std::find_if(guests_.begin(), guests_.end(), [&crowd](const Guest& guest) {
      return !guest.is_leaving && guest.address == crowd;
    });
    oldest->is_leaving = true;
    ++num_leaving_;
    // It may leave, and this place with it, before the call returns.
    const std::function<void()> evict_oldest = oldest->evict;
    evict_oldest();
    return true;
  }

  void leave(Place place) {
    if (place->is_leaving) --num_leaving_;
    guests_.erase(place);
  }

  /** Connections that were not told to go. */
  size_t size() const { return guests_.size() - num_leaving_; }

 private:
  /** The address of most guests that were not told to go; there are some. */
  std::string find_crowd() const {
    std::map<std::string_view, int> num_guests;
    for (const Guest& guest : guests_) num_guests[guest.address] += guest.is_leaving ? 0 : 1;
    const auto crowd =
        std::max_element(num_guests.begin(), num_guests.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return std::string(crowd->first);
  }

  size_t num_places_;
  std::list<Guest> guests_;
  size_t num_leaving_ = 0;
};

}  // namespace nao
