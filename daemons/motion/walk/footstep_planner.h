#pragma once

#include <Eigen/Core>
#include <vector>

#include "daemons/motion/walk/gait.h"
#include "kinematics/pose2.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** A footprint to come. */
struct PlannedStep {
  bool is_left = false;
  /** Sole in the frame that the plan was asked for. */
  Pose2 pose;
};

/** How far the feet stand outside their nominal places, each on its own side: m and rad. Walking
 * sideways and turning need room, since the closing foot must not run into the other one. */
struct Spread {
  double width = 0;
  double heading = 0;
};

/** Chooses footprints for a wished velocity.
 *
 * A body frame runs along the wished path; each foot is set down at its place beside the body, and
 * sideways and turning motion spread the feet as far as the closing foot would else come too near.
 */
class FootstepPlanner {
 public:
  FootstepPlanner(const RobotModel& model, const Gait& gait);

  /** The velocity nearest to the wished one, along its direction, that the gait holds.
   * @param velocity  m/s ahead and to the left, rad/s. */
  Eigen::Vector3d clip_velocity(const Eigen::Vector3d& velocity) const;

  /** A step towards a velocity, as large as one footstep may change it. */
  Eigen::Vector3d ramp_velocity(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  Spread spread_for(const Eigen::Vector3d& velocity) const;

  /** The steps that follow, the first with the foot that now swings.
   * @param support_is_left  The foot that stands, at the origin of the frame of the results.
   * @param spread           With which the standing foot was set down.
   * @param velocity         m/s, m/s, rad/s. @param duration  Of a step, s. */
  std::vector<PlannedStep> plan(bool support_is_left, const Spread& spread,
                                const Eigen::Vector3d& velocity, double duration, int count) const;

  /** The nearest pose to the wished one that the swinging leg reaches without touching the other.
   * @param step  Sole of the swinging foot seen from the standing one. */
  Pose2 clip_step(const Pose2& step, bool swing_is_left) const;

  /** Place of a foot in the body's frame, whose origin is what the robot turns about. */
  Pose2 foot_in_body(bool is_left, const Spread& spread) const;

 private:
  const Gait* gait_;
  WalkLimits limits_;
  /** How far a sole reaches ahead of and behind its origin, m. */
  double toe_ = 0;
  double heel_ = 0;
};

}  // namespace nao::motion
