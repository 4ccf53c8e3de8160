#include "daemons/motion/walk/walk_kick.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/walk/kick_approach.h"

namespace nao::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Time after which a kick whose ball was not reached is given up, s. Chosen: longer than the
// longest approach (8 s, see kick_approach.cpp).
constexpr double kTimeLimit = 10;
// Greatest displacement of the kicking swing towards the ball, m ahead and sideways. Chosen: the
// distance by which an approach may miss the ball's best place (kick_approach.cpp).
const Vector2d kMaxKickOffset(0.03, 0.02);

}  // namespace

void WalkKick::reset() {
  state_ = State::kNone;
  is_striking_ = false;
}

void WalkKick::request(bool with_left, const std::optional<Vector2d>& ball) {
  state_ = State::kPending;
  with_left_ = with_left;
  ball_ = ball;
  time_ = 0;
}

Vector3d WalkKick::begin_step(const Vector3d& commanded, bool support_is_left, const Pose2& body) {
  if (state_ != State::kPending || is_striking_) return commanded;
  // The kicking foot must be the swing foot of the step that begins.
  const bool kicks_next = with_left_ != support_is_left;
  if (ball_) return approach_ball(commanded, kicks_next, body);
  if (kicks_next) begin_strike(Vector2d::Zero());
  return commanded;
}

Vector3d WalkKick::approach_ball(const Vector3d& commanded, bool kicks_next, const Pose2& body) {
  if (time_ > kTimeLimit) {
    state_ = State::kMissed;
    return commanded;
  }
  // Best place of the ball in the body frame: in front of the kicking foot.
  const double foot = (with_left_ ? 0.5 : -0.5) * gait_->stance.foot_separation;
  const Vector2d best_place(gait_->kick.ball_distance - gait_->stance.turn_center, foot);
  const Vector2d offset = body.inverse() * *ball_ - best_place;
  // The operator's velocity is kept as well as the approach allows.
  const KickApproach approach =
      plan_kick_approach(offset, kicks_next, commanded.head<2>(), gait_->timing.step_duration);
  if (approach.num_steps > 0) return {approach.velocity.x(), approach.velocity.y(), 0};
  // The ball is near enough: the strike begins with this step, and the swing is displaced by the
  // rest.
  begin_strike(offset);
  return {commanded.x(), 0, 0};
}

void WalkKick::begin_strike(const Vector2d& ball_offset) {
  is_striking_ = true;
  ball_offset_ = ball_offset.cwiseMax(-kMaxKickOffset).cwiseMin(kMaxKickOffset);
}

void WalkKick::end_step() {
  if (is_striking_) state_ = State::kStruck;
  is_striking_ = false;
}

SwingOffset WalkKick::swing_offset(double phase) const {
  if (!is_striking_) return {};
  // sin^2: out and back within the step, at rest at both ends.
  const double out = std::sin(M_PI * std::clamp(phase, 0.0, 1.0));
  const Vector2d reach(gait_->kick.swing_reach + ball_offset_.x(), ball_offset_.y());
  return {out * out * reach, gait_->kick.swing_lift * out * out};
}

}  // namespace nao::motion
