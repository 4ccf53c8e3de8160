#pragma once

#include <cstdint>
#include <limits>

#include "sim/world.h"

namespace nao::sim {

/** Whether a world is at rest: nothing in it moves, and no program has changed a target or
 * commanded anything for kRestDelay. */
class RestDetector {
 public:
  /** A program acts in the world. */
  void note_activity() { num_quiet_ticks_ = 0; }
  /** A program requests images of the world. */
  void note_image_request() { num_ticks_since_request_ = 0; }

  /** A tick was run. @return Whether nothing moves. */
  bool step(const World& world) {
    const bool is_quiet = is_still(world);
    num_quiet_ticks_ = is_quiet ? num_quiet_ticks_ + 1 : 0;
    ++num_ticks_since_request_;
    return is_quiet;
  }

  bool is_at_rest(const World& world) const { return has_passed(num_quiet_ticks_, world); }
  /** Images were requested in the last kRestDelay. */
  bool has_image_request(const World& world) const {
    return !has_passed(num_ticks_since_request_, world);
  }

  /** s. An image request is valid for as long (camera_command_t). */
  static constexpr double kRestDelay = 2;

 private:
  static bool is_still(const World& world);
  static bool has_passed(int64_t num_ticks, const World& world) {
    return static_cast<double>(num_ticks) * world.options().period() >= kRestDelay;
  }

  int64_t num_quiet_ticks_ = 0;
  /** Since the last image request; at the start nobody has requested any. */
  int64_t num_ticks_since_request_ = std::numeric_limits<int32_t>::max();
};

}  // namespace nao::sim
