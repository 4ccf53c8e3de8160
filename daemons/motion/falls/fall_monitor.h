#pragma once

#include "daemons/motion/robot_state.h"

namespace nao::motion {

/** Tells a fall before the impact.
 *
 * A standing robot is lost when its capture point (centre of mass plus velocity over the pendulum's
 * rate: where it would have to step to come to rest) has left its soles for good; ankles can push
 * only as far as the soles reach. Source: Pratt et al., "Capture point", Humanoids 2006. */
class FallMonitor {
 public:
  /** @param lying_tilt  Torso tilt from which on there is no doubt, rad. */
  explicit FallMonitor(double lying_tilt) : lying_tilt_(lying_tilt) {}

  /** Looks at one tick of a robot that means to stand.
   * @param steps  True for a walk, whose next step catches what its soles cannot.
   * @return Whether it falls. */
  bool update(const RobotState& state, bool steps, double dt);

  void reset() { time_outside_ = 0; }

 private:
  double lying_tilt_;
  double time_outside_ = 0;
};

/** Capture point on the ground in the odometry frame, m. */
Eigen::Vector2d calc_capture_point(const RobotState& state);

}  // namespace nao::motion
