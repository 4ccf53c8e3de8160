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
// The feet are side by side if the one is within m and rad of its place beside the other. Chosen:
// above the placement error of a step; what is left drags a foot when the robot rises to the stand.
constexpr double kSquareDistance = 0.02;
constexpr double kSquareTurn = 0.06;
// After this many steps that should have ended the walk it marches in place until the feet are side
// by side. Without this 1 of 100 walks sideways did not end (nao-trial walk).
constexpr int kMaxEndingSteps = 3;
// Bound of the learned deviation, m. Chosen: about the reach of the ZMP on a sole.
constexpr double kMaxBias = 0.03;

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
  remaining = std::max(remaining, kMinHorizon);
  const double omega = reference.omega();
  const Vector2d zmp = control_single_support(gait_->zmp, feet.support_zmp(), reference.dcm(),
                                              dcm_.end, omega, remaining);
  const Vector2d end = advance_dcm(reference.dcm(), zmp, omega, remaining);
  return (end - dcm_.end).norm() < kSquareDistance / 2;
}

void StepPlanner::adapt_foothold(const Feet& feet, const Vector2d& end_dcm) {
  const Pose2& planned = footsteps_.front().pose;
  // The plan after this step is relative to the foothold. Moving the foothold by the deviation of
  // the DCM therefore leaves the rest of the plan valid (Englsberger et al. 2015).
  deviation_ = end_dcm - dcm_.end - bias(feet);
  foothold_ =
      planner_.clip_step({planned.position + deviation_, planned.heading}, !feet.support_is_left());
}

Spread StepPlanner::end_step(const Feet& feet, const Eigen::Vector3d& velocity) {
  Vector2d& bias = bias_[feet.support_is_left() ? 0 : 1];
  bias += gait_->feedback.bias_gain * deviation_;
  const Vector2d limit = Vector2d::Constant(kMaxBias);
  bias = bias.cwiseMax(-limit).cwiseMin(limit);
  return planner_.spread_for(velocity);
}

bool StepPlanner::is_square(const Feet& feet) const {
  const Pose2 square = planner_.square_step(feet.support_is_left());
  const Pose2& other = feet.swing().pose();
  return (other.position - square.position).norm() < kSquareDistance &&
         std::abs(wrapped(other.heading)) < kSquareTurn;
}

}  // namespace nao::motion
