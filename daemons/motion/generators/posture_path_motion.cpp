#include "daemons/motion/generators/posture_path_motion.h"

#include <algorithm>

#include "common/constants.h"
#include "daemons/motion/transitions/body_state.h"

namespace nao::motion {
namespace {

// Attempts to get up before the robot asks for help. Chosen: each of the get-up motions from the
// belly is tried, and rolls before them fail twice.
constexpr int kMaxTries = 6;
// Segments of one path. Chosen: twice the longest path with detours; more is a cycle.
constexpr int kMaxSegments = 16;
// Time in which limp motors become stiff, s. Chosen: a joint off its target does not jump to it.
constexpr double kStiffeningTime = 0.5;
// Time for which a lying body must be still before it moves, s, and time after which it moves in
// any case, s.
constexpr double kStillTime = 0.1;
constexpr double kMaxRestTime = 0.6;
// Angular velocity of the torso below which it lies still, and below which it may continue from one
// transition to the next planned one, rad/s.
constexpr double kStillVelocity = 0.3;
constexpr double kContinueVelocity = 4;
// Transition that brings feet together that stand too far apart to turn under their load, and how
// often it is played.
constexpr const char* kFeetTogether = "feet-together";
constexpr int kMaxFeetTogether = 3;
// Deviation from a standing posture above which the feet are brought together once, rad (2.5
// degrees). Chosen: servos alone stay closer.
constexpr double kOffPosture = 2.5 * kDegree;
// Deviation from a posture below which no approach transition is needed, rad.
constexpr double kNearPosture = 0.3;
// Fraction of the peak torque with which a robot lies that could not get up. Chosen: its limbs do
// not press against the floor, and yield to a person.
constexpr double kLyingStiffness = 0.1;
// Least duration of a transition's stage relative to the distance over the maximum speed. Chosen:
// the motors' own limit. TargetLimiter clips the spline, whose targets are then up to a tenth of
// the distance late at the keyframe, which the next one makes up for.
constexpr double kTransitionDurationRatio = 1;
// Time for which the targets wait at a keyframe until the direction of up is in its range, s.
// Chosen: nao-trial get-up.
constexpr double kGreatestDelay = 0.3;
// Fraction of the progress that a transition counts for: what follows it is not known yet.
constexpr double kTransitionProgress = 0.5;

bool is_lying_state(const std::string& state) {
  return state == "belly" || state == "back" || state == "left" || state == "right";
}

std::string body_state_in(const MotionContext& context) {
  return find_body_state(context.model, context.state, context.options.lying_tilt);
}

}  // namespace

// Limp motors get their stiffness first; the path begins from the measured state.
void PosturePathMotion::start(const MotionContext& context, const JointTargets& targets) {
  const bool is_stiff = std::all_of(targets.stiffness.begin(), targets.stiffness.end(),
                                    [](double stiffness) { return stiffness >= 1; });
  segment_ = is_stiff ? Segment::kResting : Segment::kStiffening;
  time_ = 0;
  note_getting_up(body_state_in(context));
}

bool PosturePathMotion::can_be_replaced() const {
  return segment_ != Segment::kTransition;
}

Mode PosturePathMotion::mode() const {
  return is_getting_up_ ? Mode::kGettingUp : Mode::kMoving;
}

double PosturePathMotion::progress() const {
  if (segment_ == Segment::kLine) return line_->progress();
  if (segment_ == Segment::kTransition) {
    return std::min(1.0, time_ / transition_.player.duration()) * kTransitionProgress;
  }
  return 0;
}

MotionGenerator::Phase PosturePathMotion::step(const MotionContext& context,
                                               JointTargets& targets) {
  time_ += context.dt;
  const bool is_still = context.state.angular_velocity_torso.norm() < kStillVelocity;
  time_still_ = is_still ? time_still_ + context.dt : 0;
  switch (segment_) {
    case Segment::kStiffening:
      stiffen(context, targets.stiffness);
      return Phase::kRunning;
    case Segment::kResting:
      return step_resting(context, targets);
    case Segment::kTransition:
      return step_transition(context, targets);
    case Segment::kLine:
      return step_line(context, targets);
  }
  return Phase::kFailed;
}

void PosturePathMotion::stiffen(const MotionContext& context, std::vector<double>& stiffness) {
  for (double& value : stiffness) value = std::min(1.0, value + context.dt / kStiffeningTime);
  if (time_ >= kStiffeningTime) rest(context);
}

MotionGenerator::Phase PosturePathMotion::step_resting(const MotionContext& context,
                                                       JointTargets& targets) {
  // A motion that was asked to end begins no further segment: the body is at rest, and the waiting
  // motion replaces it.
  if (is_finishing_) return Phase::kRunning;
  if (time_ < kMaxRestTime && must_rest(context, body_state_in(context))) return Phase::kRunning;
  const Phase phase = choose_segment(context, targets);
  // A robot that could not get up lies with soft joints: nothing works against the floor.
  if (phase == Phase::kFailed && is_lying_state(body_state_in(context))) {
    std::fill(targets.stiffness.begin(), targets.stiffness.end(), kLyingStiffness);
  }
  return phase;
}

MotionGenerator::Phase PosturePathMotion::step_line(const MotionContext& context,
                                                    JointTargets& targets) {
  const Phase phase = line_->step(context, targets);
  if (phase == Phase::kFailed && body_state_in(context) != state_of(*goal_)) {
    // The robot fell over and lies on joints, which are therefore blocked: the path is planned
    // anew.
    is_on_path_ = false;
    rest(context);
    return Phase::kRunning;
  }
  if (phase == Phase::kFailed && bring_feet_together(context, targets)) return Phase::kRunning;
  if (phase == Phase::kFailed && approach_again(context, targets)) return Phase::kRunning;
  // Feet that stand a little too far apart keep the joints off the posture, though near enough.
  if (phase == Phase::kDone && is_exact_ && is_standing_line_ && num_feet_together_ == 0 &&
      deviation_from(*goal_, context.sensors.position).angle > kOffPosture &&
      bring_feet_together(context, targets)) {
    return Phase::kRunning;
  }
  if (phase == Phase::kFailed) reason_ = line_->reason();
  if (phase != Phase::kDone) return phase;
  if (body_state_in(context) == state_of(*goal_)) return Phase::kDone;
  // The joints have arrived, but the body has not: it was tipped over in the meantime.
  rest(context);
  return Phase::kRunning;
}

void PosturePathMotion::rest(const MotionContext& context) {
  segment_ = Segment::kResting;
  time_ = 0;
  note_getting_up(body_state_in(context));
}

// A seated robot is getting up if it lay before; otherwise it only moves.
void PosturePathMotion::note_getting_up(const std::string& state) {
  if (state == kOnFeet || state == state_of(*goal_)) {
    is_getting_up_ = false;
  } else if (is_lying_state(state)) {
    is_getting_up_ = true;
  }
}

bool PosturePathMotion::must_rest(const MotionContext& context, const std::string& state) const {
  // On its feet the robot need not wait, in the air it must. Between planned transitions a moving
  // body may continue; any other lying body must have come to rest, since its state is not known
  // before.
  if (state == kOnFeet) return false;
  if (state.empty()) return true;
  if (is_on_path_) return context.state.angular_velocity_torso.norm() > kContinueVelocity;
  return time_still_ < kStillTime;
}

void PosturePathMotion::play(const MotionContext& context, const KeyframeSequence& sequence,
                             const JointTargets& targets) {
  segment_ = Segment::kTransition;
  is_at_keyframe_ = false;
  transition_ = {&sequence, KeyframePlayer(context.model, sequence, targets.position, 1.0,
                                           kTransitionDurationRatio)};
  const bool is_damped =
      std::any_of(sequence.keyframes.begin(), sequence.keyframes.end(),
                  [](const Keyframe& keyframe) { return keyframe.ankle_damping > 0; });
  if (is_damped) transition_.damping.emplace(context.model);
}

MotionGenerator::Phase PosturePathMotion::choose_segment(const MotionContext& context,
                                                         const JointTargets& targets) {
  time_ = 0;
  const std::string state = body_state_in(context);
  note_getting_up(state);
  const std::string goal_state = state_of(*goal_);
  // The last part of the path: a line through joint space on the feet.
  is_standing_line_ = state == kOnFeet && goal_state == state;
  if (++num_segments_ > kMaxSegments) {
    reason_ = Reason("path-too-long", {goal_->name, std::to_string(kMaxSegments)});
    return Phase::kFailed;
  }
  if (state == goal_state) return choose_segment_in_goal_state(context, targets);
  return choose_transition(context, targets, state);
}

MotionGenerator::Phase PosturePathMotion::choose_segment_in_goal_state(
    const MotionContext& context, const JointTargets& targets) {
  // Some postures need an approach transition when joints are far off; it is played once.
  const KeyframeSequence* approach = graph_->find_approach(*goal_);
  const bool is_near = deviation_from(*goal_, context.sensors.position).angle < kNearPosture;
  if (approach != nullptr && !has_approached_ && !is_near) {
    has_approached_ = true;
    play(context, *approach, targets);
    return Phase::kRunning;
  }
  segment_ = Segment::kLine;
  line_.emplace(*goal_, speed_);
  JointTargets start = targets;
  // The velocity of the last step is that of the spline before it comes to rest: a line that starts
  // with it would swing beyond the posture that has been reached.
  if (is_at_keyframe_ && is_standing_line_) {
    std::fill(start.velocity.begin(), start.velocity.end(), 0.0);
  }
  line_->start(context, start);
  return Phase::kRunning;
}

MotionGenerator::Phase PosturePathMotion::choose_transition(const MotionContext& context,
                                                            const JointTargets& targets,
                                                            const std::string& state) {
  const std::string goal_state = state_of(*goal_);
  // First a path without transitions that have failed; if there is none, all are tried again, in
  // the same order: a robot that could not roll by the shortest path tries the other one next.
  auto path = graph_->find_path(state, goal_state, failed_);
  if (path.empty()) {
    failed_.clear();
    path = graph_->find_path(state, goal_state);
  }
  if (path.empty()) {
    reason_ = Reason("no-path", {state.empty() ? "unknown" : state, goal_->name});
    return Phase::kFailed;
  }
  const bool is_from_lying = is_lying_state(state);
  // Each new beginning from lying counts as an attempt; after kMaxTries the robot asks for help.
  if (is_from_lying && !is_on_path_ && ++num_tries_ > kMaxTries) {
    reason_ = Reason("get-up-failed", {std::to_string(kMaxTries)});
    return Phase::kFailed;
  }
  // The alternatives of a transition that failed are tried in turn: a surface on which one fails
  // may suit another. A roll that failed says nothing about the get-up motion after it.
  const int num_failed = is_from_lying ? count_failures(*path.front()) : 0;
  play(context, graph_->find_alternative(*path.front(), num_failed), targets);
  return Phase::kRunning;
}

int PosturePathMotion::count_failures(const KeyframeSequence& sequence) const {
  // What fell after it had got up fell by its last transition, which leads to the feet.
  const int num_relapses = sequence.to == kOnFeet ? num_relapses_ : 0;
  return num_relapses + static_cast<int>(std::count_if(
                            all_failed_.begin(), all_failed_.end(), [&](const auto* failed) {
                              return failed->from == sequence.from && failed->to == sequence.to;
                            }));
}

bool PosturePathMotion::bring_feet_together(const MotionContext& context,
                                            const JointTargets& targets) {
  const KeyframeSequence* sequence = graph_->find(kFeetTogether);
  const std::string state = body_state_in(context);
  // Only where the transition starts and the goal is in the same state.
  const bool applies = sequence != nullptr && state == sequence->from && state == state_of(*goal_);
  if (!applies || num_feet_together_ >= kMaxFeetTogether) return false;
  ++num_feet_together_;
  time_ = 0;
  is_standing_line_ = false;
  play(context, *sequence, targets);
  return true;
}

bool PosturePathMotion::approach_again(const MotionContext& context, const JointTargets& targets) {
  const KeyframeSequence* approach = graph_->find_approach(*goal_);
  const bool applies = approach != nullptr && body_state_in(context) == state_of(*goal_);
  if (!applies || has_approached_again_) return false;
  has_approached_again_ = true;
  time_ = 0;
  play(context, *approach, targets);
  return true;
}

MotionGenerator::Phase PosturePathMotion::step_transition(const MotionContext& context,
                                                          JointTargets& targets) {
  int stage = transition_.player.stage_at(time_);
  const auto is_there = [&] { return body_state_in(context) == transition_.sequence->to; };
  // The last pause ends as soon as the body is in the state to which the transition leads.
  bool is_over = time_ >= transition_.player.duration() ||
                 (time_ >= transition_.player.last_arrival() && is_there());
  bool has_failed = false;
  if (stage != transition_.stage || is_over) {
    // At the end of each keyframe the direction of up must be in the keyframe's range. A body that
    // is late, with weak motors, gets some time; without it in the range the transition ends before
    // the robot works against the floor.
    has_failed = !transition_.sequence->keyframes[transition_.stage].has_up(
        context.state.torso_in_odometry.linear().row(2));
    if (has_failed && transition_.sequence->to == kOnFeet &&
        transition_.time_late < kGreatestDelay) {
      transition_.time_late += context.dt;
      time_ -= context.dt;
      stage = transition_.stage;
      is_over = has_failed = false;
    } else {
      transition_.time_late = 0;
    }
    transition_.stage = stage;
  }
  transition_.player.sample(time_, targets.position, targets.stiffness);
  if (transition_.damping) {
    const double gain = transition_.sequence->keyframes[static_cast<size_t>(stage)].ankle_damping;
    transition_.damping->add_to(context.state, gain, context.dt, targets.position);
  }
  if (!is_over && !has_failed) return Phase::kRunning;
  is_at_keyframe_ = is_over;
  is_on_path_ = !has_failed && is_there();
  if (!is_on_path_) {
    failed_.push_back(transition_.sequence);
    all_failed_.push_back(transition_.sequence);
  }
  // The next segment is chosen from the measured state, whether the transition succeeded or not.
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), 1.0);
  rest(context);
  return Phase::kRunning;
}

}  // namespace nao::motion
