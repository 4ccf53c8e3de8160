#include "daemons/motion/generators/taught_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nao::motion {
namespace {

// Time in which the motion slows down to rest, s. Chosen: at 0.1 s to a keyframe, the shortest, no
// joint decelerates by more than it accelerated.
constexpr double kSlowdownTime = 0.4;
// Least static stability margin of a posture to rest in, m; and the least one after some time, s,
// without such a posture. Chosen: TippingGuard's reserve; a tenth of the sole's width.
constexpr double kRestMargin = 0.012;
constexpr double kSmallRestMargin = 0.005;
constexpr double kRestPatience = 2;
// Greatest tilt of the flatter sole, rad, and depth of the other one below it, m: those of
// TippingGuard.
constexpr double kRestFlatness = 0.06;
constexpr double kRestLifting = 0.004;

}  // namespace

TaughtMotion::TaughtMotion(const RobotModel& model, std::shared_ptr<const ActionScript> script,
                           std::unique_ptr<MotionGenerator> approach, bool is_on_feet)
    : script_(std::move(script)),
      approach_(std::move(approach)),
      guard_(model),
      is_on_feet_(is_on_feet) {}

void TaughtMotion::start(const MotionContext& context, const JointTargets& targets) {
  approach_->start(context, targets);
}

void TaughtMotion::finish() {
  if (!is_finishing_) time_finishing_ = 0;
  is_finishing_ = true;
  if (!is_playing_) approach_->finish();
}

void TaughtMotion::begin_pass(const MotionContext& context, const JointTargets& targets) {
  player_ = KeyframePlayer(context.model, script_->sequence, targets.position, 1.0);
}

MotionGenerator::Phase TaughtMotion::step(const MotionContext& context, JointTargets& targets) {
  if (is_playing_) return play(context, targets);
  const Phase phase = approach_->step(context, targets);
  if (phase == Phase::kFailed) reason_ = approach_->reason();
  if (phase != Phase::kDone || is_finishing_) return phase;
  is_playing_ = true;
  begin_pass(context, targets);
  return Phase::kRunning;
}

MotionGenerator::Phase TaughtMotion::play(const MotionContext& context, JointTargets& targets) {
  if (is_finishing_ && !is_stopping_) {
    time_finishing_ += context.dt;
    is_stopping_ = can_rest_at(time_ + 0.5 * kSlowdownTime, context, targets);
  }
  if (is_stopping_) rate_ = std::max(0.0, rate_ - context.dt / kSlowdownTime);
  time_ += rate_ * context.dt;
  player_.sample(time_, targets.position, targets.stiffness);
  if (rate_ == 0) return Phase::kDone;
  if (time_ < player_.duration()) return Phase::kRunning;
  ++num_passes_;
  if (is_finishing_ || num_passes_ >= script_->num_repetitions) return Phase::kDone;
  time_ = 0;
  begin_pass(context, targets);
  return Phase::kRunning;
}

bool TaughtMotion::can_rest_at(double time, const MotionContext& context,
                               const JointTargets& targets) {
  if (!is_on_feet_) return true;
  JointTargets rest = targets;
  player_.sample(time, rest.position, rest.stiffness);
  const Eigen::Vector3d measured_up = context.state.torso_in_odometry.linear().row(2);
  const Eigen::Vector3d up = guard_.find_support_normal(rest.position, measured_up);
  const Equilibrium equilibrium = guard_.find_equilibrium(rest.position, up);
  const double needed = time_finishing_ < kRestPatience ? kRestMargin : kSmallRestMargin;
  return equilibrium.margin >= needed && equilibrium.flattest >= std::cos(kRestFlatness) &&
         equilibrium.lifting <= kRestLifting;
}

double TaughtMotion::progress() const {
  if (!is_playing_ || player_.duration() <= 0) return 0;
  const double passes = num_passes_ + std::min(1.0, time_ / player_.duration());
  return std::min(1.0, passes / script_->num_repetitions);
}

void TaughtMotion::describe(MotionState& state) const {
  if (!is_playing_) {
    approach_->describe(state);
    return;
  }
  state.keyframe = player_.stage_at(time_);
}

}  // namespace nao::motion
