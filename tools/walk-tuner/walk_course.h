#pragma once

#include <cstdint>

#include "daemons/motion/walk/gait.h"
#include "sim/closed_loop/closed_loop.h"

namespace nao::tool {

/** Result of a gait on one walk. */
struct WalkResult {
  /** 0 to 2; above 2 with a fall. */
  double cost = 0;
  bool has_fallen = false;
};

/** Simulated walks that a gait is evaluated by: forward, forward at 60 %, backward, sideways,
 * turning, a curve, random velocities as from a joystick (twice), a push (twice). Each has its own
 * draw of the disturbances.
 *
 * Cost of a walk with a fall: 2 to 4, more for an earlier fall. Else the sum of
 *   relative velocity error, up to 1;
 *   RMS of the torso's roll and pitch rate, 0.5 s/rad, up to 0.5;
 *   sum over the motors of the mean squared torque relative to the peak torque, times 0.2, up to
 *   0.4. */
class WalkCourse {
 public:
  /** Walks of a seed: six at constant velocities, two with a joystick, two with a push. */
  static constexpr int kNumWalks = 10;

  /** @param speed  Fraction of the model's walk limits that is commanded. */
  explicit WalkCourse(double speed) : speed_(speed) {}

  /** @param options  Model, scene, engine, disturbances and late ticks.
   * @param seed  Seed of the course; equal seeds give equal walks.
   * @param walk  Which of its walks, below kNumWalks. */
  WalkResult run(ClosedLoopOptions options, const motion::Gait& gait, uint64_t seed,
                 int walk) const;

 private:
  double speed_;
};

}  // namespace nao::tool
