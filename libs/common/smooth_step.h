#pragma once

#include <algorithm>

namespace nao {

/** Fifth-degree blend 10 s^3 - 15 s^4 + 6 s^5 from 0 to 1, with first and second derivatives of 0
 * at both ends; s outside [0, 1] is clamped.
 *
 * Source: T. Flash, N. Hogan, "The coordination of arm movements: an experimentally confirmed
 * mathematical model", J. Neuroscience 5(7), 1985: the minimum-jerk path between two points at
 * rest. */
inline double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

}  // namespace nao
