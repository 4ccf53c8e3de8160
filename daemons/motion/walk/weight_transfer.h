#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace nao::motion {

/** Planned load ratio of the swing foot in a step, 0..0.5: the fraction of the weight that it
 * carries.
 *
 * The weight is transferred linearly during the double support around each touchdown: from 0.5 to 0
 * on the foot that lifts off, then from 0 to 0.5 on the same foot as it lands.
 * @param time      Elapsed in the step, s. @param duration  Duration of the step, s.
 * @param transfer  Duration of the double support around one touchdown, s. */
inline double swing_load_ratio(double time, double duration, double transfer) {
  const double half = transfer / 2;
  const double landing = duration - half;
  double ratio = 0;
  if (half > 0 && time < half) ratio = 0.5 * (1 - time / half);
  if (half > 0 && time > landing) ratio = std::min(0.5, 0.5 * (time - landing) / half);
  return ratio;
}

/** Load ratio of the other foot in double support, 0..1, for a ZMP: the lever rule between the
 * points where the feet are loaded. @param zmp, support, other  m. */
inline double load_ratio_at_zmp(const Eigen::Vector2d& zmp, const Eigen::Vector2d& support,
                                const Eigen::Vector2d& other) {
  const Eigen::Vector2d to_other = other - support;
  return std::clamp((zmp - support).dot(to_other) / to_other.squaredNorm(), 0.0, 1.0);
}

}  // namespace nao::motion
