#pragma once

#include <Eigen/Core>

#include "daemons/motion/robot_state.h"

namespace nao::motion {

/** Torso tilt at which a walk falls, rad. Walks that recovered from a push tilted by 0.34 rad at
 * most; of those that fell, 98 of 100 tilted by this much 150 ms or more before the impact
 * (measured: nao-trial push-course). */
inline constexpr double kWalkingFallTilt = 0.38;

/** Predicts a fall before the impact.
 *
 * Standing: with the feet in place, a robot can come to rest only while its capture point is inside
 * the support polygon, since the ZMP cannot leave the soles. It falls when the capture point stays
 * outside by a margin while the soles tilt with the body.
 *
 * Walking: the next footstep moves the support polygon to the capture point. The robot falls when
 * its torso tilts more than it does in walks that recover from a push.
 *
 * Source: J. Pratt, J. Carff, S. Drakunov, A. Goswami, "Capture point: a step toward humanoid push
 * recovery", Humanoids 2006. */
class FallMonitor {
 public:
  /** @param lying_tilt  Torso tilt above which the robot falls in any case, rad. */
  explicit FallMonitor(double lying_tilt) : lying_tilt_(lying_tilt) {}

  /** One control step of a robot that must stay on its feet.
   * @param is_walking  Its next footstep can recover from a push. @param dt  s since the last step.
   * @param walking_tilt  Torso tilt at which a walk falls, rad. @return Whether it falls. */
  bool update(const RobotState& state, bool is_walking, double dt,
              double walking_tilt = kWalkingFallTilt);

  void reset() { time_outside_ = 0; }

 private:
  double lying_tilt_;
  /** Time for which the capture point has been outside of the support polygon, s. */
  double time_outside_ = 0;
};

/** Capture point xi = c + v / omega on the ground, m, odometry frame, with the center of mass's
 * ground projection c, its velocity v, and the natural frequency omega = sqrt(g / h) of the linear
 * inverted pendulum at its height h. Also called the divergent component of motion (DCM). */
Eigen::Vector2d calc_capture_point(const RobotState& state);

}  // namespace nao::motion
