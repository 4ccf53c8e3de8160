#pragma once

#include <vector>

namespace nao::motion {

/** Joint targets, each list (num_motors) in motor order. */
struct JointTargets {
  /** rad (hands: opening). */
  std::vector<double> position;
  /** Rate of change of the position targets, rad/s; a following motion continues from it. */
  std::vector<double> velocity;
  /** Fraction of the peak torque that the servo may use, 0 (limp) to 1. */
  std::vector<double> stiffness;
  /** Gains of the position servos, N m/rad and N m s/rad. Both empty: every servo's own. */
  std::vector<double> kp{};
  std::vector<double> kd{};
};

}  // namespace nao::motion
