#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "daemons/motion/walk/com_reference.h"
#include "daemons/motion/walk/dcm_plan.h"
#include "daemons/motion/walk/feet.h"
#include "daemons/motion/walk/footstep_planner.h"
#include "daemons/motion/walk/gait.h"
#include "robot_model/robot_model.h"

namespace nao::motion {

/** Plans the next footsteps and the DCM that belongs to them, adapts the foothold of the present
 * step, and learns how far its steps deviate from the pendulum.
 *
 * All points are in the support frame S, m. */
class StepPlanner {
 public:
  /** @param stand_lead  See rest_point(), m. */
  StepPlanner(const RobotModel& model, const Gait& gait, double stand_lead);

  /** Forgets plan and learned deviations. */
  void start();

  /** A step begins. @param is_ending  Its footsteps shall end the walk. */
  void begin_step(bool is_ending) { num_ending_steps_ = is_ending ? num_ending_steps_ + 1 : 0; }

  /** Plans footsteps and DCM from the present step on.
   *
   * While the walk continues, it plans five steps ahead. At its end: the present step is the last
   * one if the ZMP can bring the DCM to rest between the feet within it, else one more step
   * follows.
   * @param velocity   Velocity of the steps: m/s, m/s, rad/s.
   * @param remaining  Time to the end of the present step, s. */
  void plan(const Feet& feet, const ComReference& reference, const Eigen::Vector3d& velocity,
            bool is_ending, double remaining);
  /** No footstep follows. */
  void clear() { footsteps_.clear(); }

  /** Moves the foothold by the deviation of the DCM that is expected at the end of the step from
   * the planned one, as far as the leg reaches. @param end_dcm  Expected, m. */
  void adapt_foothold(const Feet& feet, const Eigen::Vector2d& end_dcm);

  /** The present step ended: learns from its deviation.
   * @param velocity  That its footsteps were planned for. @return Spread of the landed foot. */
  Spread end_step(const Feet& feet, const Eigen::Vector3d& velocity);

  /** The next footstep first. */
  const std::vector<PlannedStep>& footsteps() const { return footsteps_; }
  const DcmPlan& dcm() const { return dcm_; }
  /** Of the DCM from the plan beyond the learned one, m, expected at the end of the step. */
  const Eigen::Vector2d& deviation() const { return deviation_; }
  /** Where the swing foot is to land, as adapted. */
  const Pose2& foothold() const { return foothold_; }
  /** Where the center of mass rests after the walk, m: ahead of the midpoint of the feet as far as
   * in the posture that follows, so that the robot rises without moving it. */
  Eigen::Vector2d rest_point(const Feet& feet) const {
    return feet.midpoint() + Eigen::Vector2d(stand_lead_, 0);
  }
  /** The feet stand side by side. */
  bool is_square(const Feet& feet) const;
  /** The support foot seen from the body. */
  Pose2 support_in_body(const Feet& feet) const {
    return planner_.foot_in_body(feet.support_is_left(), feet.support_spread());
  }

 private:
  void plan_ahead(const Feet& feet, double omega, const Eigen::Vector3d& velocity, int num_steps,
                  bool is_ending);
  bool can_end_in_this_step(const Feet& feet, const ComReference& reference,
                            double remaining) const;
  const Eigen::Vector2d& bias(const Feet& feet) const {
    return bias_[feet.support_is_left() ? 0 : 1];
  }

  const Gait* gait_;
  FootstepPlanner planner_;
  double stand_lead_;
  /** Steps begun since the walk was asked to end. */
  int num_ending_steps_ = 0;
  std::vector<PlannedStep> footsteps_;
  Pose2 foothold_;
  DcmPlan dcm_;
  /** Deviation of the DCM at the end of steps on the left and on the right foot, m: mean. */
  std::array<Eigen::Vector2d, 2> bias_ = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  /** Deviation of the current step beyond the bias, m. */
  Eigen::Vector2d deviation_ = Eigen::Vector2d::Zero();
};

}  // namespace nao::motion
