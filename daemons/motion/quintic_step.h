#pragma once

#include <algorithm>

namespace nao::motion {

/** Greatest slope of quintic_step(), reached at s = 1/2. */
constexpr double kQuinticStepMaxSlope = 1.875;

/** Polynomial of fifth order from 0 to 1 whose velocity and acceleration are zero at both ends:
 * 10 s^3 - 15 s^4 + 6 s^5.
 *
 * @param s  Elapsed fraction of the motion; clamped to [0, 1].
 * Source: T. Flash, N. Hogan, "The coordination of arm movements", J. Neuroscience 5(7), 1985. */
inline double quintic_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

}  // namespace nao::motion
