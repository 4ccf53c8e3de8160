#pragma once

#include <algorithm>

#include "daemons/motion/walk/gait.h"

namespace nao::motion {

/** Fraction of the robot's walk limits that the walk uses, from the lag of its control loop.
 *
 * Within one lag nothing can be done about an error of the DCM, which grows by e^(omega lag). What
 * a sole and a step can still take up limits the speed.
 *
 * @param lag  From a command to the measurement of what it did, s.
 * @return 1 up to full_speed_lag, slow_speed from slow_speed_lag on, linear between. */
inline double calc_speed_fraction(const Gait::Velocity& gait, double lag) {
  const double slowness = std::clamp(
      (lag - gait.full_speed_lag) / (gait.slow_speed_lag - gait.full_speed_lag), 0.0, 1.0);
  return 1 - slowness * (1 - gait.slow_speed);
}

}  // namespace nao::motion
