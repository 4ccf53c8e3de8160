#include "daemons/motion/generators/policy_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/smooth_step.h"
#include "daemons/motion/falls/fall_monitor.h"
#include "daemons/motion/generators/walk_motion.h"
#include "daemons/motion/guards/joint_limits.h"
#include "daemons/motion/push_recovery.h"
#include "daemons/motion/standing_rates.h"
#include "daemons/motion/transitions/body_state.h"
#include "kinematics/pose2.h"
#include "policy/command_ramp.h"

namespace nao::motion {
namespace {

using Kind = PolicyManifest::Kind;

// Time at the default angles before a policy begins, in which gains and posture settle, s.
constexpr double kDefaultAnglesTime = 0.3;
// Time in which the targets change from those before to the policy's, s. Chosen: the first outputs
// of a policy may jump, since its last action is 0.
constexpr double kBlendTime = 0.1;
// Time in which the policy's part of the targets ends, s: it balances the robot meanwhile, which
// topples on the way to angles that are only held (measured: nao-trial walk). And duration of the
// return to the stand, s, at least. Chosen.
constexpr double kFadeTime = 0.3;
constexpr double kReturnTime = 0.3;
// A walk ends when the robot has been commanded to stand for the first time, s, and both feet carry
// it at less than this velocity, m/s, with every joint of the policy this near its default angle,
// rad; after the second time in any case. Measured: with one foot ahead of the other a robot tips
// over on the way to its default angles.
constexpr double kStopTime = 0.5;
constexpr double kLongestStopTime = 2.5;
constexpr double kStill = 0.15;
constexpr double kNearDefault = 0.2;
// A robot that was pushed steps in place until its stance is the default one, for at most so many
// gait cycles. Measured: with its feet apart the next push throws it over.
constexpr double kLongestRecoveryCycles = 6;
// A get-up ends when the torso of the standing robot has been upright, rad, for so long, s, with at
// most hops of this time, s. Chosen on nao-trial get-up --seeds 1701-1730: with 0.5 s every third
// of the first policies went on to its longest time.
constexpr double kUpright = 0.25;
constexpr double kUprightTime = 0.2;
constexpr double kLongestHop = 0.1;
// s without weight on any foot after which the robot has been lifted: longer than any hop.
constexpr double kLongestFlight = 0.5;

bool is_near_default(const PolicyManifest& manifest, const std::vector<double>& position) {
  return std::all_of(manifest.joints.begin(), manifest.joints.end(), [&](const PolicyJoint& joint) {
    const double angle = position[static_cast<size_t>(joint.motor)];
    return std::abs(angle - joint.default_angle) < kNearDefault;
  });
}

double tilt_of(const RobotState& state) {
  return std::acos(std::clamp(state.torso_in_odometry.linear()(2, 2), -1.0, 1.0));
}

}  // namespace

PolicyMotion::PolicyMotion(const RobotModel& model, const Policy& policy,
                           std::unique_ptr<MotionGenerator> stand_up,
                           std::unique_ptr<MotionGenerator> end, const WalkCommand& command,
                           std::function<void()> on_fault)
    : policy_(&policy),
      runner_(model, *policy.manifest, *policy.network),
      stand_up_(std::move(stand_up)),
      end_(std::move(end)),
      command_(command),
      on_fault_(std::move(on_fault)) {
  record_.policy = policy.name;
  for (const PolicyJoint& joint : policy.manifest->joints) {
    record_.joint_names.push_back(model.motor_names()[static_cast<size_t>(joint.motor)]);
  }
}

void PolicyMotion::start(const MotionContext& context, const JointTargets& targets) {
  if (!stand_up_) {
    begin_recovery(context.state, targets);
  } else if (kind() == Kind::kGetUp) {
    begin_policy(targets);
  } else if (is_walking_stance(context.model, targets.position)) {
    approach(context, targets);
  } else {
    stand_up_->start(context, targets);
  }
}

void PolicyMotion::approach(const MotionContext& context, const JointTargets& targets) {
  stage_ = Stage::kApproaching;
  time_ = 0;
  trajectory_ =
      JointTrajectory(targets.position, targets.velocity, policy_->manifest->default_position,
                      standing_rates(context, context.options.default_speed));
}

void PolicyMotion::begin_policy(const JointTargets& targets) {
  stage_ = Stage::kRunning;
  time_ = 0;
  begin_ = targets.position;
  runner_.start();
}

void PolicyMotion::begin_recovery(const RobotState& state, const JointTargets& targets) {
  if (stage_ != Stage::kRunning) begin_policy(targets);
  is_recovering_ = true;
  // The robot has no time for a change from its targets to the policy's.
  time_ = kBlendTime;
  time_at_rest_ = 0;
  runner_.restart_phase(recovery_lead(state));
}

bool PolicyMotion::is_pushed_again(const RobotState& state) const {
  if (!policy_->manifest->recovery_margin || has_failed_) return false;
  return (stage_ >= Stage::kFading && is_pushed_off(state, 0)) ||
         (stage_ == Stage::kRunning && velocity_.isZero(0) && is_pushed_at_rest(state));
}

void PolicyMotion::return_to_stand(const MotionContext& context, const JointTargets& targets) {
  stage_ = Stage::kReturning;
  time_ = 0;
  velocity_.setZero();
  trajectory_ = JointTrajectory(
      targets.position, targets.velocity, policy_->manifest->default_position,
      joint_rates(context.model, 1, context.options.free_acceleration), kReturnTime);
}

void PolicyMotion::give_up(const std::string& why) {
  has_failed_ = true;
  reason_ = Reason("policy-stopped", {policy_->name, why});
}

void PolicyMotion::fail(const std::string& why) {
  give_up(why);
  on_fault_();
}

Reason PolicyMotion::note_fall() {
  if (!is_policy_moving()) return {"robot-fell"};
  fail("the robot fell");
  return reason_;
}

MotionGenerator::Phase PolicyMotion::step(const MotionContext& context, JointTargets& targets) {
  has_record_ = false;
  time_ += context.dt;
  if (is_pushed_again(context.state)) begin_recovery(context.state, targets);
  if (stage_ == Stage::kStandingUp || stage_ == Stage::kEnding) {
    MotionGenerator& path = stage_ == Stage::kEnding ? *end_ : *stand_up_;
    if (is_finishing_) path.finish();
    const Phase phase = path.step(context, targets);
    if (phase == Phase::kRunning) return phase;
    if (stage_ == Stage::kEnding && !has_failed_ && has_ended_standing(context.state)) {
      return Phase::kDone;
    }
    if (phase == Phase::kFailed && !has_failed_) reason_ = path.reason();
    if (phase == Phase::kFailed) return phase;
    if (stage_ == Stage::kEnding) {
      // A robot that is up has got up, by whatever motion.
      return has_failed_ && kind() != Kind::kGetUp ? Phase::kFailed : Phase::kDone;
    }
    if (is_finishing_) return Phase::kDone;
    approach(context, targets);
    return Phase::kRunning;
  }
  if (is_policy_moving()) {
    if (!run(context, targets)) return_to_stand(context, targets);
  } else {
    trajectory_.sample(time_, targets.position);
    if (stage_ == Stage::kApproaching && time_ > trajectory_.duration() + kDefaultAnglesTime) {
      begin_policy(targets);
    }
    if (stage_ == Stage::kReturning && time_ > trajectory_.duration()) {
      stage_ = Stage::kEnding;
      end_->start(context, targets);
    }
  }
  // After a fault the servos have their own gains, which hold the robot best.
  if (stage_ != Stage::kEnding && !has_failed_) {
    targets.kp = policy_->manifest->kp;
    targets.kd = policy_->manifest->kd;
  }
  return Phase::kRunning;
}

bool PolicyMotion::run(const MotionContext& context, JointTargets& targets) {
  if (kind() == Kind::kWalk) steer(context);
  const PolicyManifest& manifest = *policy_->manifest;
  cycles_since_outward_ += context.dt * manifest.phase_frequency;
  if (manifest.recovery_margin && cycles_since_outward_ > kOutwardCycles) {
    if (const auto lead = find_outward_lead(context.state, kOutwardMargin)) {
      if (velocity_.isZero(0)) begin_recovery(context.state, targets);
      runner_.restart_phase(*lead);
      cycles_since_outward_ = 0;
    }
  }
  const int64_t num_steps = runner_.num_steps();
  const auto fault = runner_.step(input_of(context), context.dt);
  if (runner_.num_steps() != num_steps) record();
  if (fault) {
    fail(*fault);
    return false;
  }
  const bool is_in_air = !context.state.left_foot_carries && !context.state.right_foot_carries;
  time_in_air_ = is_in_air ? time_in_air_ + context.dt : 0;
  if (time_in_air_ > kLongestFlight && kind() != Kind::kGetUp) {
    has_failed_ = true;
    reason_ = Reason("robot-lifted");
    return false;
  }
  targets.position = manifest.default_position;
  for (size_t i = 0; i < runner_.targets().size(); ++i) {
    targets.position[static_cast<size_t>(manifest.joints[i].motor)] = runner_.targets()[i];
  }
  const bool is_fading = stage_ == Stage::kFading;
  const double blend = smooth_step(std::min(1.0, time_ / (is_fading ? kFadeTime : kBlendTime)));
  const std::vector<double>& other = is_fading ? manifest.default_position : begin_;
  const double share = is_fading ? 1 - blend : blend;
  for (size_t i = 0; i < other.size(); ++i) {
    targets.position[i] = other[i] + share * (targets.position[i] - other[i]);
  }
  if (is_fading) return time_ < kFadeTime;
  if (is_over(context, targets)) {
    stage_ = Stage::kFading;
    time_ = 0;
  }
  // A get-up that took too long returns at once.
  return !has_failed_;
}

void PolicyMotion::steer(const MotionContext& context) {
  const PolicyManifest& limits = *policy_->manifest;
  if (is_recovering_) {
    const double cycles = time_ * limits.phase_frequency;
    is_recovering_ =
        cycles < kRecoveryCycles ||
        (cycles < kLongestRecoveryCycles && !is_near_default(limits, context.sensors.position));
    velocity_ = kStepInPlace;
    return;
  }
  age_ += context.dt;
  Eigen::Vector3d goal(std::clamp(command_.vx, limits.vx.lower, limits.vx.upper),
                       std::clamp(command_.vy, limits.vy.lower, limits.vy.upper),
                       std::clamp(command_.wz, limits.wz.lower, limits.wz.upper));
  // The walk ends when the sender falls silent: a lost phone must not leave a robot walking.
  const bool is_silent = age_ > kCommandLifetime;
  if (is_silent || is_finishing_) goal.setZero();
  reason_ = is_silent ? Reason("walk-command-timeout", {to_argument(kCommandLifetime)}) : Reason();
  velocity_ = ramp_command(velocity_, goal, context.dt);
}

bool PolicyMotion::has_ended_standing(const RobotState& state) const {
  return kind() != Kind::kAction && end_->reason().code == "posture-not-reached" &&
         state.left_foot_carries && state.right_foot_carries && tilt_of(state) < kUpright;
}

bool PolicyMotion::is_over(const MotionContext& context, const JointTargets& targets) {
  const RobotState& state = context.state;
  switch (kind()) {
    case Kind::kWalk: {
      time_at_rest_ = velocity_.isZero(0) ? time_at_rest_ + context.dt : 0;
      const bool is_near = is_near_default(*policy_->manifest, context.sensors.position);
      const bool stands = state.left_foot_carries && state.right_foot_carries &&
                          state.velocity_torso_in_heading.head<2>().norm() < kStill && is_near;
      if (time_at_rest_ > kStopTime && stands) return true;
      if (time_at_rest_ <= kLongestStopTime) return false;
      if (is_near || has_closed_stance_ || !policy_->manifest->recovery_margin) return true;
      // Feet on the ground stay where they are: push recovery steps in place until they are closer.
      has_closed_stance_ = true;
      begin_recovery(context.state, targets);
      return false;
    }
    case Kind::kGetUp:
      time_at_rest_ = tilt_of(state) < kUpright && is_above_seat(context.model, state) &&
                              time_in_air_ < kLongestHop
                          ? time_at_rest_ + context.dt
                          : 0;
      if (time_at_rest_ > kUprightTime) return true;
      if (time_ < policy_->manifest->duration) return false;
      give_up("the robot did not stand within " + to_argument(policy_->manifest->duration) + " s");
      return true;
    default:
      return is_finishing_ || time_ > policy_->manifest->duration;
  }
}

void PolicyMotion::record() {
  record_.observation = runner_.observation();
  record_.action = runner_.action();
  record_.inference_time = runner_.inference_time();
  has_record_ = true;
}

PolicyInput PolicyMotion::input_of(const MotionContext& context) const {
  const RobotState& state = context.state;
  const Eigen::Matrix3d torso_in_odometry = state.torso_in_odometry.linear();
  const Eigen::AngleAxisd heading(heading_of(torso_in_odometry), Eigen::Vector3d::UnitZ());
  PolicyInput input;
  input.angular_velocity = context.sensors.gyroscope_torso;
  // By the inertial unit, as in training and on the robots of other people's policies: the estimate
  // that follows the accelerometer faster is off by 0.1 rad after 10 s at 1 m/s (measured).
  input.projected_gravity =
      -(context.sensors.orientation_torso_in_world.conjugate() * Eigen::Vector3d::UnitZ());
  input.linear_velocity =
      torso_in_odometry.transpose() * (heading * state.velocity_torso_in_heading);
  input.command = velocity_;
  input.joint_position = context.sensors.position;
  input.joint_velocity = context.sensors.velocity;
  return input;
}

bool PolicyMotion::can_be_replaced() const {
  switch (stage_) {
    case Stage::kStandingUp:
      return stand_up_->can_be_replaced();
    case Stage::kEnding:
      // After a fault the robot stands first.
      return !has_failed_ && end_->can_be_replaced();
    case Stage::kApproaching:
      return true;
    default:
      return false;
  }
}

bool PolicyMotion::adopt(const Command& command) {
  const auto* walk = std::get_if<WalkCommand>(&command.request);
  const bool is_ending = stage_ >= Stage::kFading;
  if (walk == nullptr || kind() != Kind::kWalk || is_ending) return false;
  command_ = *walk;
  age_ = 0;
  return true;
}

double PolicyMotion::progress() const {
  if (kind() == Kind::kWalk || !is_policy_moving()) return MotionGenerator::progress();
  return std::min(1.0, time_ / policy_->manifest->duration);
}

Mode PolicyMotion::mode() const {
  if (stage_ == Stage::kStandingUp) return stand_up_->mode();
  if (stage_ == Stage::kEnding) return end_->mode();
  return kind() == Kind::kWalk    ? Mode::kWalking
         : kind() == Kind::kGetUp ? Mode::kGettingUp
                                  : Mode::kActing;
}

bool PolicyMotion::must_stay_upright() const {
  if (stage_ == Stage::kStandingUp) return stand_up_->must_stay_upright();
  if (stage_ == Stage::kEnding) return end_->must_stay_upright();
  return kind() != Kind::kGetUp;
}

std::optional<double> PolicyMotion::fall_tilt() const {
  return is_policy_moving() ? policy_->manifest->fall_tilt : std::nullopt;
}

void PolicyMotion::describe(MotionState& state) const {
  if (stage_ == Stage::kStandingUp) return stand_up_->describe(state);
  if (stage_ == Stage::kEnding) return end_->describe(state);
  state.walk_velocity = velocity_;
}

}  // namespace nao::motion
