#pragma once

#include <algorithm>

#include "daemons/motion/walk/gait.h"

namespace nao::motion {

/** How much slower than its limits a robot walks because of the lag of its control loop.
 *
 * Within one lag an error of the DCM cannot be corrected and grows by e^(omega lag). The error that
 * a sole and a step can still absorb limits the speed.
 *
 * @param lag  From a command to the measurement of what it did, s.
 * @return 0 up to full_speed_lag, 1 from slow_speed_lag on, linear between: slow_speed,
 *   slow_turning and slow_envelope_exponent hold at 1. */
inline double calc_slowness(const Gait::Velocity& gait, double lag) {
  return std::clamp((lag - gait.full_speed_lag) / (gait.slow_speed_lag - gait.full_speed_lag), 0.0,
                    1.0);
}

}  // namespace nao::motion
