#include "daemons/motion/generators/walk_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "kinematics/pose2.h"

namespace nao::motion {
namespace {

// Least stiffness of the legs: the vendor's walk refuses at 0.6 or less.
constexpr double kLeastStiffness = 0.6;
// Torso tilted more than this falls, rad.
constexpr double kFallingTilt = 0.6;
// s without weight on any foot after which the robot has been lifted: longer than any hop.
constexpr double kLiftedTime = 0.2;

// Bounds of a stance in which a walk can begin, besides the robot's WalkingStance: tilt of the
// soles, rad; difference of their heights, m; and turn from each other, rad.
constexpr double kLevel = 0.06;
constexpr double kSameHeight = 0.01;
constexpr double kGreatestTurn = 0.7;

// Move-to: velocity per distance left, 1/s; it has arrived within m and rad.
constexpr double kApproach = 1.2;
constexpr double kArrivedDistance = 0.012;
constexpr double kArrivedTurn = 0.025;
// Distance beyond which it is faster to turn towards the goal and walk ahead, m.
constexpr double kFar = 0.4;
// Greatest angle to the goal, rad, at which the robot walks ahead.
constexpr double kAimed = 0.5;
// Factor on the expected duration of the path after which it gives up, and an additional time, s.
constexpr double kPatience = 3;
constexpr double kPatienceAtLeast = 10;

}  // namespace

std::optional<Reason> find_soft_leg(const LegKinematics& legs,
                                    const std::vector<double>& stiffness) {
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    for (int motor : legs.motors(leg)) {
      if (stiffness[motor] <= kLeastStiffness) {
        // Percentages are for people.
        return Reason("legs-too-soft", {std::to_string(std::lround(100 * stiffness[motor])),
                                        std::to_string(std::lround(100 * kLeastStiffness))});
      }
    }
  }
  return std::nullopt;
}

std::optional<Reason> find_orientation_doubt(const RobotState& state) {
  if (state.orientation_doubt == 0) return std::nullopt;
  return Reason("orientation-doubtful",
                {std::to_string(std::lround(state.orientation_doubt / kDegree))});
}

std::optional<Reason> find_walk_obstacle(const LegKinematics& legs, const RobotState& state,
                                         const std::vector<double>& stiffness) {
  if (auto soft = find_soft_leg(legs, stiffness)) return soft;
  if (auto doubt = find_orientation_doubt(state)) return doubt;
  // (2, 2) is the cosine of the torso's tilt.
  if (state.torso_in_odometry.linear()(2, 2) < std::cos(kFallingTilt)) {
    return Reason("not-upright");
  }
  if (!state.left_foot_carries && !state.right_foot_carries) {
    return Reason("no-foot-contact");
  }
  return std::nullopt;
}

double calc_hip_height(const Kinematics& kinematics, const LegKinematics& legs) {
  const Eigen::Vector3d hips = 0.5 * (legs.hip(Leg::kLeft) + legs.hip(Leg::kRight));
  return (kinematics.left_sole().inverse() * hips).z();
}

bool is_walking_stance(const RobotModel& model, const std::vector<double>& position) {
  Kinematics kinematics(model);
  kinematics.update(position);
  // The right sole in the frame of the left one: level, at one height, within the stance's bounds.
  const Eigen::Isometry3d right = kinematics.left_sole().inverse() * kinematics.right_sole();
  const double height = calc_hip_height(kinematics, LegKinematics(model));
  const WalkingStance& bounds = model.references().walking_stance;
  const double apart = -right.translation().y();
  const double turn = heading_of(right.linear());
  return right.linear()(2, 2) > std::cos(kLevel) &&
         std::abs(right.translation().z()) < kSameHeight && apart > bounds.least_width &&
         apart < bounds.greatest_width &&
         std::abs(right.translation().x()) < bounds.greatest_lead &&
         std::abs(turn) < kGreatestTurn && height > bounds.least_hip_height;
}

WalkingMotion::WalkingMotion(const RobotModel& model, const Gait& gait,
                             std::unique_ptr<MotionGenerator> stand_up)
    : engine_(model, gait, model.ready_posture()), stand_up_(std::move(stand_up)) {}

void WalkingMotion::start(const MotionContext& context, const JointTargets& targets) {
  is_standing_up_ = !is_walking_stance(context.model, targets.position);
  if (is_standing_up_) {
    stand_up_->start(context, targets);
  } else {
    engine_.start(targets);
    start_steering(context);
  }
}

std::optional<Reason> WalkingMotion::find_trouble(const MotionContext& context) {
  if (context.state.torso_in_odometry.linear()(2, 2) < std::cos(kFallingTilt)) {
    // In a step a foot often loses contact for a moment; the time without any contact decides.
    return Reason("balance-lost");
  }
  const bool is_in_air = !context.state.left_foot_carries && !context.state.right_foot_carries;
  time_in_air_ = is_in_air ? time_in_air_ + context.dt : 0;
  if (time_in_air_ > kLiftedTime) return Reason("robot-lifted");
  return std::nullopt;
}

MotionGenerator::Phase WalkingMotion::step(const MotionContext& context, JointTargets& targets) {
  if (is_standing_up_) {
    const Phase phase = stand_up_->step(context, targets);
    if (phase == Phase::kFailed) reason_ = stand_up_->reason();
    if (phase != Phase::kDone) return phase;
    is_standing_up_ = false;
    if (is_finishing_) return Phase::kDone;
    engine_.start(targets);
    start_steering(context);
    return Phase::kRunning;
  }
  // This is checked only now: the path from a seat to a stand leads over back and belly, with the
  // feet in the air.
  if (const auto trouble = find_trouble(context)) {
    reason_ = *trouble;
    return Phase::kFailed;
  }
  auto obstacle = find_soft_leg(engine_.legs(), targets.stiffness);
  if (!obstacle) obstacle = find_orientation_doubt(context.state);
  if (obstacle) {
    reason_ = *obstacle;
    // Soft legs do not carry a step, and a wrong orientation does not balance one: within a step
    // the walk is ended by a step that brings the robot to rest, otherwise it ends at once.
    if (engine_.stage() != WalkEngine::Stage::kStepping) return Phase::kFailed;
    engine_.end();
  } else if (!is_finishing_) {
    reason_ = Reason();
    steer(context);
  }
  // The walk advances by one control period at most. When motion was kept from running for some
  // ticks the servos have held their targets: continuing from there keeps the robot on its feet
  // three times as often as catching up with a jump (nao-trial walk --vx 0.3 --late 0.03).
  const double advance = std::min(context.dt, context.sensors.period);
  if (engine_.step(context.state, context.kinematics, advance, targets)) return Phase::kRunning;
  // The walk has ended. Why decides what comes next: soft legs failed; a motion waits; the operator
  // gave a new velocity in the meantime; or the walk is done.
  if (!reason_.empty()) return Phase::kFailed;
  if (is_finishing_) {
    // The motion that waits takes over in the next tick.
    return std::exchange(has_ended_, true) ? Phase::kDone : Phase::kRunning;
  }
  if (wants_to_go_on()) {
    engine_.start(targets);
    return Phase::kRunning;
  }
  return conclude(context, reason_) ? Phase::kDone : Phase::kFailed;
}

bool WalkingMotion::can_be_replaced() const {
  // During the first weight transfer and after the end the robot stands on both feet.
  if (is_standing_up_) return stand_up_->can_be_replaced();
  switch (engine_.stage()) {
    case WalkEngine::Stage::kLowering:
    case WalkEngine::Stage::kDone:
      return true;
    default:
      return false;
  }
}

void WalkingMotion::finish() {
  is_finishing_ = true;
  if (is_standing_up_) {
    stand_up_->finish();
  } else {
    engine_.end();
  }
}

void WalkingMotion::describe(MotionState& state) const {
  if (is_standing_up_) return;
  state.walk_velocity = engine_.velocity();
  for (const PlannedStep& step : engine_.footsteps_in_odometry()) {
    state.footsteps.push_back({step.is_left, step.pose.position, wrapped(step.pose.heading)});
  }
}

WalkMotion::WalkMotion(const RobotModel& model, const Gait& gait,
                       std::unique_ptr<MotionGenerator> stand_up,
                       const std::optional<WalkCommand>& command)
    : WalkingMotion(model, gait, std::move(stand_up)),
      model_(&model),
      command_(command.value_or(WalkCommand{})),
      answers_push_(!command) {}

void WalkMotion::start(const MotionContext& context, const JointTargets& targets) {
  if (!answers_push_) return WalkingMotion::start(context, targets);
  engine().start_pushed(context.state, context.kinematics, context.sensors.period, targets);
}

bool WalkMotion::adopt(const Command& command) {
  if (answers_push_) return false;
  // A kick or a new velocity while walking is taken into the running walk. false: the command needs
  // a motion of its own.
  if (const auto* action = std::get_if<ActionCommand>(&command.request)) {
    const Action* known = model_->find_action(action->action);
    const Side side = known != nullptr ? known->side : Side::kNone;
    if (engine().stage() != WalkEngine::Stage::kStepping) return false;
    std::optional<Eigen::Vector2d> ball;
    if (!std::isnan(action->ball_x) && !std::isnan(action->ball_y)) {
      // Commands give the ball relative to the midpoint of the feet.
      ball = engine().midpoint_in_odometry() * Eigen::Vector2d(action->ball_x, action->ball_y);
    }
    engine().kick().request(side == Side::kLeft, ball);
    return true;
  }
  const auto* walk = std::get_if<WalkCommand>(&command.request);
  if (walk == nullptr) return false;
  command_ = *walk;
  age_ = 0;
  return true;
}

std::optional<WalkCommand> WalkMotion::gait_command() const {
  return mode() == Mode::kWalking ? std::optional(command_) : std::nullopt;
}

MotionGenerator::Strike WalkMotion::strike() const {
  switch (engine().kick().state()) {
    case WalkKick::State::kPending:
      return engine().stage() == WalkEngine::Stage::kStepping ? Strike::kPending : Strike::kNone;
    case WalkKick::State::kStruck:
      return Strike::kStruck;
    case WalkKick::State::kMissed:
      return Strike::kMissed;
    default:
      return Strike::kNone;
  }
}

void WalkMotion::steer(const MotionContext& context) {
  age_ += context.dt;
  const Eigen::Vector3d velocity(command_.vx, command_.vy, command_.wz);
  // The walk ends when the sender falls silent: a lost phone must not leave a robot walking.
  if (age_ > kCommandLifetime || velocity.isZero(0)) {
    engine().end();
  } else {
    engine().resume();
    engine().set_velocity(velocity);
  }
}

bool WalkMotion::wants_to_go_on() const {
  return !is_zero(command_) && age_ <= kCommandLifetime;
}

bool WalkMotion::conclude(const MotionContext& /*context*/, Reason& reason) {
  if (age_ > kCommandLifetime && !answers_push_)
    reason = Reason("walk-command-timeout", {to_argument(kCommandLifetime)});
  return true;
}

MoveToMotion::MoveToMotion(const RobotModel& model, const Gait& gait,
                           std::unique_ptr<MotionGenerator> stand_up, const MoveToCommand& command)
    : WalkingMotion(model, gait, std::move(stand_up)),
      command_(command),
      turn_center_(gait.stance.turn_center),
      limits_(model.walk_limits()) {}

Pose2 MoveToMotion::standing_body(const RobotState& state) const {
  return body_between(Pose2::from(state.left_sole_in_odometry),
                      Pose2::from(state.right_sole_in_odometry), turn_center_);
}

void MoveToMotion::start_steering(const MotionContext& context) {
  // The goal is where the torso shall stand, as it stands now; the feet give this place more
  // accurately than a swaying torso.
  const Pose2 torso = Pose2::from(context.state.torso_in_odometry);
  const Pose2 body_in_torso = torso.inverse() * standing_body(context.state);
  goal_in_odometry_ = torso * Pose2{{command_.x, command_.y}, command_.theta} * body_in_torso;
  // Length of the path, m, with 0.15 m for each rad of turning, for the progress only.
  way_ = std::hypot(command_.x, command_.y) + 0.15 * std::abs(command_.theta);
  const double turn = std::abs(wrapped(command_.theta)) + 2 * M_PI;
  time_limit_ = kPatienceAtLeast + kPatience * (std::hypot(command_.x, command_.y) /
                                                    // The time limit assumes the slowest direction
                                                    // plus a full turn.
                                                    std::min(limits_.forward, limits_.sideways) +
                                                turn / limits_.turning);
}

Pose2 MoveToMotion::remaining(const MotionContext& context) const {
  const bool steps = engine().stage() == WalkEngine::Stage::kStepping;
  // While stepping, the body frame that the plan is based on; it does not sway as the torso does.
  const Pose2 body = steps ? engine().body_in_odometry() : standing_body(context.state);
  return body.inverse() * goal_in_odometry_;
}

void MoveToMotion::steer(const MotionContext& context) {
  time_ += context.dt;
  const Pose2 left = remaining(context);
  const double distance = left.position.norm();
  const double turn = wrapped(left.heading);
  const double left_way = distance + 0.15 * std::abs(turn);
  if (way_ > 0) progress_ = std::max(progress_, std::clamp(1 - left_way / way_, 0.0, 1.0));
  // Once there, it stays there: the last steps may shift the robot by millimeters.
  is_there_ = is_there_ || (distance < kArrivedDistance && std::abs(turn) < kArrivedTurn);
  if (is_there_ || time_ > time_limit_) {
    engine().end();
    return;
  }
  // Proportional control of the remaining pose, clipped to the limits of the walk below.
  Eigen::Vector3d velocity(kApproach * left.position.x(), kApproach * left.position.y(),
                           kApproach * turn);
  if (distance > kFar) {
    // Far away: turn towards the goal and walk ahead; sideways it walks more slowly. The factor
    // falls linearly to 0 at kAimed rad.
    const double aim = std::atan2(left.position.y(), left.position.x());
    velocity.z() = kApproach * aim;
    const double share = std::clamp(1 - std::abs(aim) / kAimed, 0.0, 1.0);
    velocity.x() = share * std::max(0.0, velocity.x());
    velocity.y() *= share;
  }
  const Eigen::Vector3d greatest(velocity.x() > 0 ? limits_.forward : limits_.backward,
                                 limits_.sideways, limits_.turning);
  engine().set_velocity(velocity.cwiseMax(-greatest).cwiseMin(greatest));
}

bool MoveToMotion::conclude(const MotionContext& context, Reason& reason) {
  if (is_there_) {
    progress_ = 1;
    return true;
  }
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f", remaining(context).position.norm());
  reason = Reason("goal-timeout", {text.data()});
  return false;
}

}  // namespace nao::motion
