#include "daemons/motion/generators/journey_motion.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

constexpr int kMaxTries = 6;
// A way has few legs; more than this is going round in circles.
constexpr int kMaxLegs = 16;
// Motors that were limp become stiff over this time, s.
constexpr double kStiffeningTime = 0.5;
// A body that lies must have lain still this long before it moves, and is not waited for longer, s.
constexpr double kStillTime = 0.1;
constexpr double kLongestRest = 0.6;
// Torso that lies still, and one that goes on from one transition to the next as planned, turn more
// slowly than this, rad/s.
constexpr double kStill = 0.3;
constexpr double kSlow = 4;
// Feet that stand too far apart to turn under their load are brought together by this transition,
// so many times.
constexpr const char* kFeetTogether = "feet-together";
constexpr int kMaxFeetTogether = 3;
// Joints this near to a posture go straight to it, rad.
constexpr double kNear = 0.3;

bool is_lying(const std::string& state) {
  return state == "belly" || state == "back" || state == "left" || state == "right";
}

}  // namespace

void JourneyMotion::start(const MotionContext& /*context*/, const JointTargets& targets) {
  const bool is_stiff = std::all_of(targets.stiffness.begin(), targets.stiffness.end(),
                                    [](double share) { return share >= 1; });
  leg_ = is_stiff ? Leg::kResting : Leg::kStiffening;
  time_ = 0;
}

bool JourneyMotion::can_be_replaced() const {
  return leg_ != Leg::kTransition;
}

Mode JourneyMotion::mode() const {
  return leg_ == Leg::kTransition && is_from_lying_ ? Mode::kGettingUp : Mode::kMoving;
}

double JourneyMotion::progress() const {
  if (leg_ == Leg::kDirect) return direct_->progress();
  if (leg_ == Leg::kTransition) return std::min(1.0, time_ / player_.duration()) * 0.5;
  return 0;
}

MotionGenerator::Phase JourneyMotion::step(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  const bool is_still = context.state.angular_velocity_torso.norm() < kStill;
  time_still_ = is_still ? time_still_ + context.dt : 0;
  switch (leg_) {
    case Leg::kStiffening:
      for (double& share : targets.stiffness) {
        share = std::min(1.0, share + context.dt / kStiffeningTime);
      }
      if (time_ >= kStiffeningTime) {
        leg_ = Leg::kResting;
        time_ = 0;
      }
      return Phase::kRunning;
    case Leg::kResting: {
      if (is_finishing_) return Phase::kRunning;
      const std::string state =
          find_body_state(context.model, context.state, context.options.lying_tilt);
      if (time_ < kLongestRest && must_rest(context, state)) return Phase::kRunning;
      return choose_leg(context, targets);
    }
    case Leg::kTransition:
      return step_transition(context, targets);
    case Leg::kDirect: {
      const Phase phase = direct_->step(context, targets);
      if (phase == Phase::kFailed && brings_feet_together(context, targets)) {
        return Phase::kRunning;
      }
      if (phase == Phase::kFailed) reason_ = direct_->reason();
      if (phase != Phase::kDone) return phase;
      if (find_body_state(context.model, context.state, context.options.lying_tilt) ==
          state_of(*goal_)) {
        return Phase::kDone;
      }
      leg_ = Leg::kResting;
      time_ = 0;
      return Phase::kRunning;
    }
  }
  return Phase::kFailed;
}

bool JourneyMotion::must_rest(const MotionContext& context, const std::string& state) const {
  if (state == "on-feet") return false;
  if (is_on_its_way_) return context.state.angular_velocity_torso.norm() > kSlow;
  return time_still_ < kStillTime;
}

void JourneyMotion::play(const MotionContext& context, const KeyframeSequence& sequence,
                         const JointTargets& targets) {
  leg_ = Leg::kTransition;
  sequence_ = &sequence;
  stage_ = 0;
  player_ = KeyframePlayer(context.model, sequence, targets.position, 1.0);
}

MotionGenerator::Phase JourneyMotion::choose_leg(const MotionContext& context,
                                                 const JointTargets& targets) {
  time_ = 0;
  const std::string state =
      find_body_state(context.model, context.state, context.options.lying_tilt);
  stands_ = state == "on-feet" && state_of(*goal_) == state;
  if (++num_legs_ > kMaxLegs) {
    reason_ = Reason("path-too-long", {goal_->name, std::to_string(kMaxLegs)});
    return Phase::kFailed;
  }
  if (state == state_of(*goal_)) {
    const KeyframeSequence* approach = graph_->find_approach(*goal_);
    const bool is_near = deviation_from(*goal_, context.sensors.position).angle < kNear;
    if (approach != nullptr && !has_approached_ && !is_near) {
      has_approached_ = true;
      is_from_lying_ = false;
      play(context, *approach, targets);
      return Phase::kRunning;
    }
    leg_ = Leg::kDirect;
    direct_.emplace(*goal_, speed_);
    direct_->start(context, targets);
    return Phase::kRunning;
  }
  auto way = graph_->find_way(state, state_of(*goal_), failed_);
  if (way.empty()) way = graph_->find_way(state, state_of(*goal_));
  if (way.empty()) {
    reason_ = Reason("no-path", {state.empty() ? "unknown" : state, goal_->name});
    return Phase::kFailed;
  }
  is_from_lying_ = is_lying(state);
  if (is_from_lying_ && !is_on_its_way_ && ++num_tries_ > kMaxTries) {
    reason_ = Reason("get-up-failed", {std::to_string(kMaxTries)});
    return Phase::kFailed;
  }
  const int num_failed = is_from_lying_ ? num_tries_ - 1 : 0;
  play(context, graph_->find_alternative(*way.front(), num_failed), targets);
  return Phase::kRunning;
}

bool JourneyMotion::brings_feet_together(const MotionContext& context,
                                         const JointTargets& targets) {
  const KeyframeSequence* sequence = graph_->find(kFeetTogether);
  const std::string state =
      find_body_state(context.model, context.state, context.options.lying_tilt);
  const bool can = sequence != nullptr && state == sequence->from && state == state_of(*goal_);
  if (!can || num_feet_together_ >= kMaxFeetTogether) return false;
  ++num_feet_together_;
  time_ = 0;
  stands_ = false;
  is_from_lying_ = false;
  play(context, *sequence, targets);
  return true;
}

MotionGenerator::Phase JourneyMotion::step_transition(const MotionContext& context,
                                                      JointTargets& targets) {
  player_.sample(time_, targets.position, targets.stiffness);
  const auto is_there = [&] {
    return find_body_state(context.model, context.state, context.options.lying_tilt) ==
           sequence_->to;
  };
  const bool is_over =
      time_ >= player_.duration() || (time_ >= player_.last_arrival() && is_there());
  const int stage = player_.stage_at(time_);
  bool has_failed = false;
  if (stage != stage_ || is_over) {
    const Keyframe& ended = sequence_->keyframes[stage_];
    const Eigen::Vector3d up = context.state.torso_in_odometry.linear().row(2);
    for (int axis = 0; axis < 3; ++axis) has_failed |= !ended.up[axis].has(up[axis]);
    stage_ = stage;
  }
  if (!is_over && !has_failed) return Phase::kRunning;
  is_on_its_way_ = !has_failed && is_there();
  if (!is_on_its_way_) failed_.push_back(sequence_);
  // Where the body is now, the next leg sees.
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), 1.0);
  leg_ = Leg::kResting;
  time_ = 0;
  return Phase::kRunning;
}

}  // namespace nao::motion
