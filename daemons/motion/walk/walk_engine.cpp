#include "daemons/motion/walk/walk_engine.h"

#include <algorithm>
#include <cmath>

#include "common/constants.h"
#include "common/smooth_step.h"
#include "daemons/motion/walk/pendulum.h"
#include "daemons/motion/walk/speed_limit.h"
#include "daemons/motion/walk/step_timing.h"
#include "daemons/motion/walk/weight_transfer.h"
#include "daemons/motion/walk/zmp_control.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Fraction of a step's duration after which load on the swing foot ends it. Chosen: before, the
// foot is not above its foothold, and the load comes from the liftoff.
constexpr double kEarliestTouchdown = 0.6;
// The weight transfer before the first step is given up after this many times its duration.
constexpr double kMaxStarting = 4;
// Time in which the targets change from the stand's to the walk's after a push, s. Chosen: in 0.1 s
// a T1 hops.
constexpr double kPushedFadeTime = 0.2;
// A push is over when the DCM is expected so near its planned end point, m. Chosen: more than in
// walks without pushes.
constexpr double kPushedDeviation = 0.02;
// A sideways velocity above this, m/s, decides which foot steps first; else the turn does.
constexpr double kSidewaysStart = 0.02;

// The end posture may hold the center of mass elsewhere over the soles than the walk; the last
// steps put the feet so that it need not move when the robot rises.
/** How much farther ahead of the sole the center of mass is in a posture than in the walk, m. */
double calc_stand_lead(const RobotModel& model, const Gait& gait, const Posture& posture) {
  Kinematics kinematics(model);
  kinematics.update(posture.position);
  return (kinematics.left_sole().inverse() * kinematics.center_of_mass()).x() -
         gait.stance.zmp_forward;
}

}  // namespace

WalkEngine::WalkEngine(const RobotModel& model, const Gait& gait, const Posture& end_posture)
    : gait_(&gait),
      weight_(model.total_mass() * kGravity),
      velocity_(model, gait),
      kick_(gait),
      steps_(model, gait, calc_stand_lead(model, gait, end_posture)),
      feet_(gait),
      reference_(gait),
      observer_(gait),
      body_(model, gait, end_posture) {}

void WalkEngine::start(const JointTargets& targets) {
  stage_ = Stage::kLowering;
  time_ = 0;
  walk_fraction_ = 0;
  is_ending_ = false;
  is_capturing_ = false;
  is_pushed_ = false;
  velocity_.stop();
  kick_.reset();
  steps_.start();
  lag_.start(gait_->feedback.initial_lag);
  observer_.start();
  body_.read_start(targets.position);
  feet_.start(body_.pose().start_right_sole());
  reference_.start(feet_.midpoint(), body_.pose().start_com_height());
  duration_ = body_.pose().lowering_duration();
  body_.start(body_command());
}

void WalkEngine::start_pushed(const RobotState& state, const Kinematics& measured, double dt,
                              const JointTargets& targets) {
  start(targets);
  observer_.start(true);
  observer_.update(state, measured.center_of_mass(), feet_.support_is_left(), reference_,
                   body_.pose().torso_pitch(), dt);
  reference_.start_at(observer_.com());
  // The foot on the side to which the robot moves steps.
  if (reference_.dcm().y() > feet_.midpoint().y()) exchange_support();
  reference_.set_zmp(feet_.support_zmp());
  is_ending_ = true;
  is_pushed_ = true;
  begin_step();
  body_.read_start(targets.position);
  body_.start(body_command());
}

bool WalkEngine::step(const RobotState& state, const Kinematics& measured, double dt,
                      JointTargets& targets) {
  if (stage_ == Stage::kDone) return false;
  // The measurements come first, since they refer to the commands up to the last tick.
  lag_.update(body_.position(), state.joint_position, body_.pose().motors(), dt);
  observer_.update(state, measured.center_of_mass(), feet_.support_is_left(), reference_,
                   body_.pose().torso_pitch(), dt);
  time_ += dt;
  kick_.advance(dt);
  switch (stage_) {
    case Stage::kLowering:
      step_lowering();
      break;
    case Stage::kStarting:
      step_starting(dt);
      break;
    case Stage::kStepping:
      step_stepping(dt);
      break;
    default:
      step_stopping(dt);
      break;
  }
  // The stage may have changed above.
  if (stage_ == Stage::kRaising) {
    walk_fraction_ = 1 - smooth_step(time_ / gait_->timing.raise_duration);
    if (time_ >= gait_->timing.raise_duration) stage_ = Stage::kDone;
  }
  body_.step(body_command(), observer_, dt, targets);
  // This follows the body's step, so that the last tick of stopping is still a tick of the walk.
  if (stage_ == Stage::kStopping && time_ >= gait_->timing.stop_duration) begin_raising();
  return stage_ != Stage::kDone;
}

BodyCommand WalkEngine::body_command() const {
  using Transition = BodyCommand::Transition;
  Transition transition = Transition::kNone;
  if (stage_ == Stage::kLowering) transition = Transition::kFromStart;
  if (stage_ == Stage::kRaising || stage_ == Stage::kDone) transition = Transition::kToEnd;
  return {reference_,
          feet_,
          kick_.swing_offset(time_ / duration_),
          other_load_ratio_,
          stage_ != Stage::kStepping,
          transition,
          walk_fraction_};
}

void WalkEngine::step_lowering() {
  walk_fraction_ = smooth_step(time_ / duration_);
  reference_.rest_at(feet_.midpoint());
  other_load_ratio_ = 0.5;
  if (time_ < duration_) return;
  if (is_ending_) {
    begin_raising();
  } else {
    begin_starting();
  }
}

void WalkEngine::begin_starting() {
  stage_ = Stage::kStarting;
  time_ = 0;
  duration_ = gait_->timing.start_duration;
  walk_fraction_ = 1;
  // The first swing foot is the one on the side that the walk or the turn goes to: it can step
  // outward at once, the other one would have to close first.
  const Vector3d target = velocity_.clip(commanded_);
  const double to_left = std::abs(target.y()) > kSidewaysStart ? target.y() : target.z();
  const bool swing_is_left = to_left > 0;
  // The exchange changes which foot S belongs to, and nothing that the robot does.
  if (swing_is_left == feet_.support_is_left()) {
    exchange_support();
  }
  plan_steps();
}

void WalkEngine::step_starting(double dt) {
  // The reference does not follow the measurement: both feet stand, and a reference that moves with
  // an error of the measurement would move the center of mass to the edge of the soles.
  const double remaining = std::max(duration_ - time_, kMinHorizon);
  const Vector2d start_dcm = steps_.dcm().start;
  reference_.set_zmp(control_double_support(gait_->zmp, feet_, reference_.dcm(), start_dcm,
                                            reference_.omega(), remaining));
  // The load follows the ZMP: its position between the nominal points of both feet.
  other_load_ratio_ = load_ratio_at_zmp(reference_.zmp(), feet_.support_zmp(), feet_.other_zmp());
  reference_.advance(dt);
  // The first step begins when the DCM has passed the point where the plan has it start.
  // Lateral distance that the DCM still has to go, positive while it has not reached the start.
  const double to_go = feet_.side() * (start_dcm.y() - reference_.dcm().y());
  // A robot that is held, or whose DCM does not get there, begins to step nevertheless.
  if (to_go > 0 && time_ < kMaxStarting * duration_) return;
  velocity_.start_path(body_in_odometry());
  begin_step();
}

void WalkEngine::begin_step() {
  stage_ = Stage::kStepping;
  time_ = 0;
  // After a push the DCM moves away exponentially: the sooner the foot lands, the less far.
  duration_ = is_pushed_ ? gait_->timing.min_step_duration : gait_->timing.step_duration;
  // Where the robot is by odometry, for path tracking and the approach to a ball.
  const Pose2 body = body_in_odometry();
  Vector3d target = Vector3d::Zero();
  if (!is_ending_) target = kick_.begin_step(commanded_, feet_.support_is_left(), body);
  // A longer lag leaves less stability: the envelope shrinks with it.
  velocity_.set_slowness(calc_slowness(gait_->velocity, lag_.lag()));
  velocity_.begin_step(target, body, is_ending_, !is_capturing_ && !kick_.seeks_ball());
  // This is set before plan_steps(), so that it plans the last step.
  is_capturing_ = is_ending_;
  steps_.begin_step(is_ending_);
  plan_steps();
}

// end() within a step: the step that has begun is planned anew with zero velocity, unless a kick is
// under way or the step is nearly over.
void WalkEngine::begin_capture() {
  is_capturing_ = true;
  if (kick_.is_striking() || duration_ - time_ < kMinHorizon) return;
  velocity_.stop();
  plan_steps();
}

void WalkEngine::step_stepping(double dt) {
  if (is_ending_ && !is_capturing_) begin_capture();
  velocity_.advance(dt);
  walk_fraction_ = std::min(1.0, walk_fraction_ + dt / kPushedFadeTime);
  // The reference moves towards the measured center of mass by com_position_gain and
  // com_velocity_gain: ZMP and plan then start from where the robot is.
  reference_.follow(observer_.com(), dt);
  control_dcm();
  reference_.advance(dt);
  move_swing_foot(dt);
  if (has_landed(dt)) change_support();
}

void WalkEngine::control_dcm() {
  const double omega = reference_.omega();
  // The DCM that footstep and timing are planned for: the reference's, and a fraction of the error.
  const Vector2d error = reference_.dcm_error(observer_.com());
  const Vector2d dcm = reference_.dcm() + gait_->feedback.footstep_gain * error;
  const Vector2d nominal = feet_.support_zmp();
  // Lateral distances from the ZMP, positive towards the swing foot.
  const double zmp_y = -feet_.side() * nominal.y();
  const LateralDcm lateral{-feet_.side() * dcm.y() - zmp_y,
                           -feet_.side() * steps_.dcm().end.y() - zmp_y};
  if (!is_pushed_) duration_ = adapt_step_duration(*gait_, lateral, omega, time_, duration_);

  const double remaining = duration_ - time_;
  if (remaining <= kMinHorizon) return;
  // The ZMP brings the reference to the planned DCM as far as the sole reaches. The rest, and the
  // error, move the foothold.
  reference_.set_zmp(control_single_support(gait_->zmp, nominal, reference_.dcm(), steps_.dcm().end,
                                            omega, remaining));
  steps_.adapt_foothold(feet_, advance_dcm(dcm, reference_.zmp(), omega, remaining));
}

void WalkEngine::move_swing_foot(double dt) {
  // Planned load of the swing foot, 0 in the middle of the step; double support is divided between
  // the beginning and the end of the step.
  other_load_ratio_ = swing_load_ratio(time_, duration_, gait_->timing.double_support_duration);
  const SwingTiming swing = time_swing(*gait_, time_, duration_);
  if (swing.is_swinging) {
    feet_.swing().step(steps_.foothold(), swing.remaining, swing.phase, gait_->swing.height, dt);
  }
  feet_.level_support(dt);
}

bool WalkEngine::has_landed(double dt) {
  const bool is_loaded = observer_.swing_force() > gait_->swing.touchdown_load_ratio * weight_;
  const bool is_late = time_ >= duration_ - 1e-9;
  // Late: no contact at the planned time (a hole, or the robot leans away). The foot is lowered
  // towards the ground, and the step waits for contact until late_duration has passed.
  if (is_late && !is_loaded && time_ < duration_ + gait_->timing.late_duration) {
    SwingFoot& swing = feet_.swing();
    swing.lower(std::min(gait_->swing.late_speed * dt,
                         std::max(0.0, gait_->swing.late_depth + swing.height())));
    return false;
  }
  // Early contact ends the step as well: the foot stands, and pushing it on would tip the robot.
  return is_late || (is_loaded && time_ > kEarliestTouchdown * duration_);
}

void WalkEngine::change_support() {
  kick_.end_step();
  is_pushed_ = is_pushed_ && steps_.deviation().norm() > kPushedDeviation;
  const Spread spread = steps_.end_step(feet_, velocity_.step_velocity());
  reference_.change_frame(feet_.exchange(spread));
  // The walk is over when velocity is 0 and the feet are side by side; otherwise one more step.
  if (is_ending_ && velocity_.velocity().isZero(1e-6) && steps_.is_square(feet_)) {
    stage_ = Stage::kStopping;
    time_ = 0;
    steps_.clear();
  } else {
    begin_step();
  }
}

void WalkEngine::step_stopping(double dt) {
  reference_.follow(observer_.com(), dt);
  reference_.set_zmp(control_double_support(gait_->zmp, feet_, reference_.dcm(),
                                            steps_.rest_point(feet_), reference_.omega(),
                                            gait_->timing.stop_horizon));
  other_load_ratio_ = load_ratio_at_zmp(reference_.zmp(), feet_.support_zmp(), feet_.other_zmp());
  reference_.advance(dt);
  feet_.level_both(dt);
}

void WalkEngine::begin_raising() {
  stage_ = Stage::kRaising;
  time_ = 0;
  velocity_.stop();
}

std::vector<PlannedStep> WalkEngine::footsteps_in_odometry() const {
  // Steps are planned in S; the plan is published relative to odometry.
  const Pose2& support = observer_.sole_in_odometry(feet_.support_is_left());
  std::vector<PlannedStep> steps = steps_.footsteps();
  for (PlannedStep& step : steps) step.pose = support * step.pose;
  return steps;
}

Pose2 WalkEngine::body_in_odometry() const {
  return observer_.sole_in_odometry(feet_.support_is_left()) *
         steps_.support_in_body(feet_).inverse();
}

}  // namespace nao::motion
