#pragma once

#include <cstdint>

#include "sim/world.h"

namespace nao::sim {

/** Whether a world is at rest: nothing in it moves, and no program has changed a target, commanded
 * anything or requested images for kRestDelay. */
class RestDetector {
 public:
  /** A program acts in the world, or watches it. */
  void note_activity() { num_quiet_ticks_ = 0; }

  /** A tick was run. @return Whether nothing moves. */
  bool step(const World& world) {
    const bool is_quiet = is_still(world);
    num_quiet_ticks_ = is_quiet ? num_quiet_ticks_ + 1 : 0;
    return is_quiet;
  }

  bool is_at_rest(const World& world) const {
    return static_cast<double>(num_quiet_ticks_) * world.options().period() >= kRestDelay;
  }

  /** s. Chosen: image requests are repeated once a second. */
  static constexpr double kRestDelay = 2;

 private:
  static bool is_still(const World& world);

  int64_t num_quiet_ticks_ = 0;
};

}  // namespace nao::sim
