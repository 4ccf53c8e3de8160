#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>

#include "daemons/motion/actions/taught_script.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao {

/** When a simulation ends before the motion does. */
struct RolloutEnd {
  /** Time from the command at which Stop is sent, s. */
  double stop_time = std::numeric_limits<double>::infinity();
  /** Ends the simulation at once when another thread sets it; nullptr: never. */
  const std::atomic<bool>* is_cancelled = nullptr;
};

/** Simulates a taught motion as nao-motion plays it: from its start posture, through its keyframes,
 * and some time of holding the last one.
 *
 * @param options  Model, scene, engine and disturbances; the start posture is the motion's.
 * @param seed     Seed of what is drawn.
 * @return What went wrong, and at which keyframe: "motion-fall", "motion-self-contact",
 *   "motion-joint-blocked" or "motion-blocked"; nothing if the motion was played to its end. */
std::optional<motion::MotionFault> roll_out(const ClosedLoopOptions& options, uint64_t seed,
                                            const motion::ActionScript& script,
                                            const RolloutEnd& end = {});

}  // namespace nao
