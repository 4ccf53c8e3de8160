#pragma once

#include <algorithm>

namespace nao::motion {

/** Fraction of the robot's walk limits that the walk uses, from the lag of its control loop.
 *
 * Within one lag nothing can be done about an error of the DCM, which grows by e^(omega lag): 1.2
 * at 30 ms, 1.4 at 55 ms. What a sole and a step can still take up limits the speed.
 *
 * @param lag  From a command to the measurement of what it did, s.
 * @return 1 up to kFullSpeedLag, kSlowSpeed from kSlowSpeedLag on, linear between. */
inline double calc_speed_fraction(double lag) {
  // s. Chosen: a robot with commands one or two ticks of 10 ms late measures 20 to 32 ms; one with
  // 36 ms and ticks of 12 ms, 48 to 56 ms.
  constexpr double kFullSpeedLag = 0.04;
  constexpr double kSlowSpeedLag = 0.048;
  // Of 20 walks of 6 s under disturbances/real.yaml fall 2 at 0.22 m/s and 13 at 0.3 m/s.
  constexpr double kSlowSpeed = 0.65;
  const double slowness =
      std::clamp((lag - kFullSpeedLag) / (kSlowSpeedLag - kFullSpeedLag), 0.0, 1.0);
  return 1 - slowness * (1 - kSlowSpeed);
}

}  // namespace nao::motion
