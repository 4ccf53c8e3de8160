#include "daemons/motion/walk/step_planner.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/walk/zmp_control.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;

// Number of footsteps planned ahead. Chosen: the fifth changes the DCM of the present step by
// e^(-4 omega T) = 0.2 % of its own displacement, which is below a millimeter.
constexpr int kNumPlannedSteps = 5;
// The feet are side by side if the one is turned by less than this, rad, and near its place beside
// the other (square_distance). Chosen: above the placement error of a step.
constexpr double kSquareTurn = 0.06;
// After this many steps that should have ended the walk it marches in place until the feet are side
// by side. Without this 1 of 100 walks sideways did not end (nao-trial walk).
constexpr int kMaxEndingSteps = 3;

}  // namespace

StepPlanner::StepPlanner(const RobotModel& model, const Gait& gait, double stand_lead)
    : gait_(&gait), planner_(model, gait), stand_lead_(stand_lead) {}

void StepPlanner::start() {
  num_ending_steps_ = 0;
  footsteps_.clear();
  bias_.fill(Vector2d::Zero());
  deviation_.setZero();
}

void StepPlanner::plan(const Feet& feet, const ComReference& reference,
                       const Eigen::Vector3d& velocity, bool is_ending, double remaining) {
  const double omega = reference.omega();
  // While walking, and after kMaxEndingSteps steps that did not end the walk, five steps are
  // planned. To end, first one step is tried, then two: the DCM must come to its end point.
  if (!is_ending || num_ending_steps_ > kMaxEndingSteps) {
    plan_ahead(feet, omega, velocity, kNumPlannedSteps, is_ending);
    return;
  }
  plan_ahead(feet, omega, velocity, 1, is_ending);
  if (!can_end_in_this_step(feet, reference, remaining)) {
    plan_ahead(feet, omega, velocity, 2, is_ending);
  }
}

void StepPlanner::plan_ahead(const Feet& feet, double omega, const Eigen::Vector3d& velocity,
                             int num_steps, bool is_ending) {
  const double duration = gait_->timing.step_duration;
  footsteps_ =
      planner_.plan(feet.support_is_left(), feet.support_spread(), velocity, duration, num_steps);
  // The foothold of the present step, in S.
  foothold_ = footsteps_.front().pose;
  // The ZMP of each step is the nominal one of its support foot.
  std::vector<Vector2d> zmps = {feet.support_zmp()};
  for (const PlannedStep& step : footsteps_) {
    zmps.push_back(step.pose * feet.nominal_zmp(step.is_left));
  }
  // After the last step the robot stands on both feet: at rest between them.
  Vector2d final_dcm = 0.5 * (zmps[num_steps - 1] + zmps[num_steps]);
  if (is_ending) final_dcm.x() += stand_lead_;
  zmps.pop_back();
  dcm_ = plan_dcm(zmps, final_dcm, omega, duration);
}

bool StepPlanner::can_end_in_this_step(const Feet& feet, const ComReference& reference,
                                       double remaining) const {
  // The final DCM stands for all steps beyond the plan; its error decays on the way back to the
  // present step, see plan_dcm().
  remaining = std::max(remaining, kMinHorizon);
  // Whether the ZMP can bring the DCM to the planned end point in the time that remains.
  const double omega = reference.omega();
  const Vector2d zmp = control_single_support(gait_->zmp, feet.support_zmp(), reference.dcm(),
                                              dcm_.end, omega, remaining);
  const Vector2d end = advance_dcm(reference.dcm(), zmp, omega, remaining);
  return (end - dcm_.end).norm() < gait_->step_limits.square_distance / 2;
}

void StepPlanner::adapt_foothold(const Feet& feet, const Vector2d& end_dcm) {
  const Pose2& planned = footsteps_.front().pose;
  // The plan after this step is relative to the foothold. Moving the foothold by the deviation of
  // the DCM therefore leaves the rest of the plan valid (Englsberger et al. 2015).
  // The learned bias is subtracted: a deviation that is the same in every step is not a
  // disturbance.
  deviation_ = end_dcm - dcm_.end - bias(feet);
  foothold_ =
      planner_.clip_step({planned.position + deviation_, planned.heading}, !feet.support_is_left());
}

Spread StepPlanner::end_step(const Feet& feet, const Eigen::Vector3d& velocity) {
  // One bias for each support foot: deviations to the left and right differ in sign. Integral
  // action with bias_gain in each step, clamped (anti-windup).
  Vector2d& bias = bias_[feet.support_is_left() ? 0 : 1];
  bias += gait_->feedback.bias_gain * deviation_;
  const Vector2d limit = Vector2d::Constant(gait_->feedback.max_bias);
  bias = bias.cwiseMax(-limit).cwiseMin(limit);
  return planner_.spread_for(velocity);
}

bool StepPlanner::is_square(const Feet& feet) const {
  const Pose2 square = planner_.square_step(feet.support_is_left());
  const Pose2& other = feet.swing().pose();
  return (other.position - square.position).norm() < gait_->step_limits.square_distance &&
         std::abs(wrapped(other.heading)) < kSquareTurn;
}

}  // namespace nao::motion
