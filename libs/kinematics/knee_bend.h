#pragma once

#include <algorithm>
#include <cmath>

namespace nao {

/** Angle between two links, rad, [0, pi] with 0 = stretched, by the law of cosines.
 * @param thigh, tibia  Lengths of the links, m.
 * @param distance  Between their far ends, m. Beyond reach: the angle of the nearest reach.
 * @param is_reachable  Set to whether the links reach the distance. */
inline double knee_bend(double thigh, double tibia, double distance, bool& is_reachable) {
  // Rounding only.
  constexpr double kCosineTolerance = 1e-12;
  const double cosine = (distance * distance - thigh * thigh - tibia * tibia) / (2 * thigh * tibia);
  is_reachable = cosine <= 1 + kCosineTolerance && cosine >= -1 - kCosineTolerance;
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace nao
