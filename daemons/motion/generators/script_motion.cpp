#include "daemons/motion/generators/script_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/constants.h"
#include "daemons/motion/falls/fall_monitor.h"
#include "daemons/motion/generators/walk_motion.h"

namespace nao::motion {
namespace {

// Greatest shift of the CoP on the soles, m: half their length less a margin, and inward as far as
// their round inner edge is flat.
constexpr double kReachForward = 0.045;
constexpr double kReachSideways = 0.02;

}  // namespace

ScriptMotion::ScriptMotion(const RobotModel& model, const ActionScript& script, const Gait& gait,
                           std::unique_ptr<MotionGenerator> stand_up,
                           std::unique_ptr<MotionGenerator> get_up)
    : model_(&model),
      script_(&script),
      gait_(&gait),
      stand_up_(std::move(stand_up)),
      get_up_(std::move(get_up)),
      legs_(model),
      feedforward_(model) {}

void ScriptMotion::start(const MotionContext& context, const JointTargets& targets) {
  if (is_walking_stance(context.model, targets.position)) {
    start_playing(context, targets);
    return;
  }
  part_ = Part::kStandingUp;
  stand_up_->start(context, targets);
}

void ScriptMotion::start_playing(const MotionContext& context, const JointTargets& targets) {
  part_ = Part::kPlaying;
  time_ = 0;
  player_ = KeyframePlayer(context.model, script_->sequence, targets.position, 1.0);
}

MotionGenerator::Phase ScriptMotion::step(const MotionContext& context, JointTargets& targets) {
  if (part_ == Part::kPlaying) return play(context, targets);
  // Standing up before, or getting up after the script.
  MotionGenerator& way = part_ == Part::kStandingUp ? *stand_up_ : *get_up_;
  const Phase phase = way.step(context, targets);
  if (phase == Phase::kFailed) reason_ = way.reason();
  if (phase != Phase::kDone || part_ == Part::kGettingUp || is_finishing_) return phase;
  start_playing(context, targets);
  return Phase::kRunning;
}

MotionGenerator::Phase ScriptMotion::play(const MotionContext& context, JointTargets& targets) {
  time_ += context.dt;
  player_.sample(time_, targets.position, targets.stiffness);
  if (script_->balance_gain > 0) balance(context, targets);
  if (time_ < player_.duration()) return Phase::kRunning;
  // A script that ends on the ground (a keeper's dive) continues with getting up.
  if (script_->end == ActionScript::End::kOnFeet) return Phase::kDone;
  std::fill(targets.stiffness.begin(), targets.stiffness.end(), 1.0);
  part_ = Part::kGettingUp;
  get_up_->start(context, targets);
  return Phase::kRunning;
}

void ScriptMotion::balance(const MotionContext& context, JointTargets& targets) {
  const RobotState& state = context.state;
  gyroscope_.update(state.angular_velocity_torso, context.dt);
  if (!state.left_foot_carries || !state.right_foot_carries) return;
  const Pose2 left = Pose2::from(state.left_sole_in_odometry);
  const Pose2 right = Pose2::from(state.right_sole_in_odometry);
  const Eigen::Vector2d ahead(gait_->stance.zmp_forward, 0);
  // The walk keeps the CoP over this point between the feet; here it is at the same place on the
  // soles.
  const Eigen::Vector2d middle = 0.5 * (left * ahead + right * ahead);
  const Eigen::Vector2d error = calc_capture_point(state) - middle;
  // Each foot is taken to carry half of the weight; the ankle torque tau = m g / 2 * x moves its
  // CoP by x.
  const double half_weight = 0.5 * model_->total_mass() * kGravity;
  // The targets end at angles: what the ankles add fades with the last keyframe.
  const double left_time = player_.duration() - time_;
  const double share = std::clamp(left_time / 0.3, 0.0, 1.0);
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const Pose2& sole = leg == Leg::kLeft ? left : right;
    const Eigen::Vector2d reach(kReachForward, kReachSideways);
    // In the axes of this sole.
    const Eigen::Vector2d steer =
        (script_->balance_gain * (Eigen::Rotation2Dd(-sole.heading) * error))
            .cwiseMax(-reach)
            .cwiseMin(reach);
    const LegRoles& roles = legs_.roles(leg);
    const auto add = [&](int role, double torque, double angle) {
      if (role < 0) return;
      const int motor = legs_.motors(leg)[role];
      const double sign = roles.sign[role];
      targets.position[motor] +=
          share * (feedforward_.calc_offset(motor, sign * torque, 0, 0) + sign * angle);
    };
    // Toes pressed down move the CoP forward; a sole rolled to its left moves it to its left.
    add(roles.ankle_pitch, half_weight * steer.x(),
        gait_->orientation.gyro_ankle_pitch * gyroscope_.value().y());
    add(roles.ankle_roll, -half_weight * steer.y(),
        gait_->orientation.gyro_ankle_roll * gyroscope_.value().x());
  }
}

bool ScriptMotion::can_be_replaced() const {
  switch (part_) {
    case Part::kStandingUp:
      return stand_up_->can_be_replaced();
    case Part::kPlaying:
      return false;
    case Part::kGettingUp:
      return get_up_->can_be_replaced();
  }
  return true;
}

void ScriptMotion::finish() {
  is_finishing_ = true;
  if (part_ == Part::kStandingUp) stand_up_->finish();
  if (part_ == Part::kGettingUp) get_up_->finish();
}

Mode ScriptMotion::mode() const {
  return part_ == Part::kGettingUp ? get_up_->mode() : Mode::kActing;
}

bool ScriptMotion::must_stay_upright() const {
  if (part_ == Part::kGettingUp) return get_up_->must_stay_upright();
  return part_ == Part::kStandingUp || script_->end == ActionScript::End::kOnFeet;
}

double ScriptMotion::progress() const {
  if (part_ == Part::kStandingUp) return 0;
  const double played = std::min(1.0, time_ / player_.duration());
  if (script_->end == ActionScript::End::kOnFeet) return played;
  const double up = part_ == Part::kGettingUp ? get_up_->progress() : 0;
  return 0.5 * played + 0.5 * (std::isnan(up) ? 0 : up);
}

}  // namespace nao::motion
