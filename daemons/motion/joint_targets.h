#pragma once

#include <vector>

namespace nao::motion {

/** Where the joints shall go, each list (num_motors) in motor order. */
struct JointTargets {
  /** rad (hands: opening). */
  std::vector<double> position;
  /** How fast the targets move, rad/s; what a following motion takes over from. */
  std::vector<double> velocity;
  /** Share of the motor's torque that the servo may use, 0 limp to 1. */
  std::vector<double> stiffness;
};

}  // namespace nao::motion
