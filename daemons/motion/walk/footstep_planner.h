#pragma once

#include <Eigen/Core>
#include <vector>

#include "daemons/motion/walk/gait.h"
#include "kinematics/pose2.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** A planned footstep. */
struct PlannedStep {
  bool is_left = false;
  /** Sole in the frame that the plan was asked for. */
  Pose2 pose;
};

/** How far each foot is placed outward of its nominal place beside the body: m and rad. Sideways
 * steps and turns need it, because the closing foot must not touch the other one. */
struct Spread {
  double width = 0;
  double heading = 0;
};

/** Places footsteps for a velocity.
 *
 * A body frame moves along the commanded path; each foot is placed beside it. Sideways and turning
 * velocities spread the feet as far as the closing foot would otherwise come too near. */
class FootstepPlanner {
 public:
  FootstepPlanner(const RobotModel& model, const Gait& gait);

  /** Spread of the feet at a velocity: m/s, m/s, rad/s. */
  Spread spread_for(const Eigen::Vector3d& velocity) const;

  /** Plans the next footsteps, the first of them with the present swing foot.
   * @param support_is_left  The support foot, at the origin of the frame of the results.
   * @param spread           Spread with which the support foot was placed.
   * @param velocity         m/s, m/s, rad/s. @param duration  Duration of a step, s. */
  std::vector<PlannedStep> plan(bool support_is_left, const Spread& spread,
                                const Eigen::Vector3d& velocity, double duration, int count) const;

  /** The nearest footstep that the leg reaches without a contact of the feet.
   * @param step  Sole of the swing foot seen from the support foot. */
  Pose2 clip_step(const Pose2& step, bool swing_is_left) const;

  /** Place of a foot in the body frame. Turns are about the origin of that frame. */
  Pose2 foot_in_body(bool is_left, const Spread& spread) const;

  /** Place of the swing foot beside the support foot without spread. */
  Pose2 square_step(bool support_is_left) const;

 private:
  const Gait* gait_;
  /** From the sole's origin to the front and to the rear of its outline, m. */
  double toe_ = 0;
  double heel_ = 0;
};

/** Body frame of a robot that stands on both feet: between the soles, ahead by turn_center.
 * @param left, right  Soles in any common frame. */
Pose2 body_between(const Pose2& left, const Pose2& right, double turn_center);

}  // namespace nao::motion
