#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace nao::gateway {

/** The requests of a client that sends each over two connections: what comes first counts. */
class RequestCopies {
 public:
  /** @return false if the request has been taken already, over the other connection. */
  bool take(uint32_t request_id) {
    uint32_t& taken = taken_[request_id % taken_.size()];
    if (request_id != 0 && taken == request_id) return false;
    taken = request_id;
    return true;
  }

  /** A request was taken that moves or stops the robot. @return false if a later one was before. */
  bool is_newest_motion(uint32_t request_id) {
    const bool is_newest = request_id >= newest_motion_;
    newest_motion_ = std::max(newest_motion_, request_id);
    return is_newest;
  }

 private:
  /** Chosen: what a client may send in more than 5 s at 100 a second, after which a connection that
   * nothing comes over is closed. */
  std::array<uint32_t, 512> taken_{};
  uint32_t newest_motion_ = 0;
};

}  // namespace nao::gateway
