#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <list>
#include <utility>

namespace nao {

/** Connections that have not said Connect yet. There is room for so many; one more closes the
 * oldest, so that a crowd of half-open connections cannot keep others out. */
class WaitingRoom {
 private:
  struct Guest {
    std::function<void()> evict;
    bool is_leaving = false;
  };

 public:
  using Place = std::list<Guest>::iterator;

  explicit WaitingRoom(size_t num_places) : num_places_(num_places) {}

  /** @param evict  Closes the connection, which leaves then or some time after.
   * @return true if another connection was closed for it. */
  bool enter(std::function<void()> evict, Place& place) {
    guests_.push_back({std::move(evict), false});
    place = std::prev(guests_.end());
    if (guests_.size() - num_leaving_ <= num_places_) return false;
    const Place oldest = std::find_if(guests_.begin(), guests_.end(),
                                      [](const Guest& guest) { return !guest.is_leaving; });
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
  size_t num_places_;
  std::list<Guest> guests_;
  size_t num_leaving_ = 0;
};

}  // namespace nao
