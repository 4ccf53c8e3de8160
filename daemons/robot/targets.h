#pragma once

#include <vector>

namespace nao::robot {

/** Targets of the servos, in motor order. */
struct Targets {
  /** rad (hands: opening), (num_motors). */
  std::vector<double> position;
  /** Fraction of the peak torque, 0 (limp) to 1, (num_motors). */
  std::vector<double> stiffness;
};

}  // namespace nao::robot
