#include "daemons/motion/generators/kick_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/constants.h"
#include "common/smooth_step.h"
#include "daemons/motion/generators/walk_motion.h"

namespace nao::motion {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// The servos' offsets fade in at the start and out at the end, where the targets are angles, s.
constexpr double kFade = 0.3;
// Part of the hips' height by which they may be higher or lower than in the ready posture, for
// which a kick is made. Chosen: a walk leaves 0.1 %; 4 % more straighten a NAO's knees, and its
// foot has 0.6 of its speed.
constexpr double kSameHipHeight = 0.02;

/** Whether a kick can begin in the pose that these targets make. */
bool is_kick_stance(const RobotModel& model, const LegKinematics& legs,
                    const std::vector<double>& position) {
  if (!is_walking_stance(model, position)) return false;
  Kinematics kinematics(model);
  kinematics.update(model.ready_posture().position);
  const double ready = calc_hip_height(kinematics, legs);
  kinematics.update(position);
  return std::abs(calc_hip_height(kinematics, legs) - ready) < kSameHipHeight * ready;
}

}  // namespace

std::optional<Reason> KickMotion::find_obstacle(const Kick& kick, bool is_left,
                                                const Vector2d& ball) {
  const Vector2d best(kick.ball.x(), (is_left ? 1 : -1) * kick.ball.y());
  // Only coordinates that are given are checked; the reason gives the range in which the ball must
  // lie, m, in the frame of the command.
  for (int i = 0; i < 2; ++i) {
    if (std::isnan(ball[i]) || std::abs(ball[i] - best[i]) <= kick.ball_reach[i]) continue;
    const Vector2d least = best - kick.ball_reach;
    const Vector2d greatest = best + kick.ball_reach;
    return Reason("ball-out-of-reach", {to_argument(least.x()), to_argument(greatest.x()),
                                        to_argument(least.y()), to_argument(greatest.y())});
  }
  return std::nullopt;
}

KickMotion::KickMotion(const RobotModel& model, const Kick& kick, const Gait& gait,
                       std::unique_ptr<MotionGenerator> stand_up, bool is_left,
                       const Vector2d& ball, double strength)
    : model_(&model),
      kick_(&kick),
      gait_(&gait),
      stand_up_(std::move(stand_up)),
      is_left_(is_left),
      ball_(ball),
      strength_(std::clamp(std::isnan(strength) ? kick.strength : strength, 0.0, 1.0)),
      trajectory_(kick, is_left, ball, strength_),
      pose_(model, is_left),
      feedforward_(model),
      kinematics_(model),
      // The foot's signals are those of one strength.
      watch_(kick.impact && strength_ == kick.strength ? &*kick.impact : nullptr, pose_.legs(),
             is_left) {}

void KickMotion::start(const MotionContext& context, const JointTargets& targets) {
  // From any other posture the robot stands up first, and the kick begins from there.
  is_standing_up_ = !is_kick_stance(context.model, pose_.legs(), targets.position);
  if (is_standing_up_) {
    stand_up_->start(context, targets);
  } else {
    start_kick(context, targets);
  }
}

Vector2d KickMotion::choose_ball(const MotionContext& context) const {
  if (!std::isnan(ball_.x()) || !std::isnan(ball_.y())) return ball_;
  const std::optional<Vector2d> seen = KickWatch::find_ball(context);
  return seen && !find_obstacle(*kick_, is_left_, *seen) ? *seen : ball_;
}

void KickMotion::start_kick(const MotionContext& context, const JointTargets& targets) {
  time_ = 0;
  trajectory_ = KickTrajectory(*kick_, is_left_, choose_ball(context), strength_);
  watch_.start(context, trajectory_.strike_end());
  kinematics_.update(targets.position);
  trajectory_.start_from(pose_.start(kinematics_));
  last_planned_com_ = trajectory_.at(0).com;
  // Where the support sole was at the start: the kick's path holds over the ground even if the sole
  // turns under the load, see hold_path_over_ground().
  start_in_odometry_ = support_in_odometry(context.state);
  reference_position_ = targets.position;
}

Pose2 KickMotion::support_in_odometry(const RobotState& state) const {
  // Support frame S of the kick, in odometry: the sole's pose without its own heading at the start.
  const Isometry3d& sole = is_left_ ? state.right_sole_in_odometry : state.left_sole_in_odometry;
  return Pose2::from(sole) * Pose2{Vector2d::Zero(), -pose_.support_heading()};
}

MotionGenerator::Phase KickMotion::step(const MotionContext& context, JointTargets& targets) {
  if (is_standing_up_) {
    const Phase phase = stand_up_->step(context, targets);
    if (phase == Phase::kFailed) reason_ = stand_up_->reason();
    if (phase != Phase::kDone) return phase;
    is_standing_up_ = false;
    // A motion that was asked to end does not begin to kick.
    if (is_finishing_) return Phase::kDone;
    start_kick(context, targets);
    return Phase::kRunning;
  }
  time_ += context.dt;
  follow(context, trajectory_.at(time_), targets);
  watch_.step(context, time_);
  if (time_ < trajectory_.duration()) return Phase::kRunning;
  const KickWatch::Verdict verdict = watch_.judge();
  reason_ = verdict.reason;
  return verdict.is_missed ? Phase::kFailed : Phase::kDone;
}

void KickMotion::follow(const MotionContext& context, const KickReference& planned,
                        JointTargets& targets) {
  const RobotState& state = context.state;
  const Pose2 start_in_support = support_in_odometry(state).inverse() * start_in_odometry_;
  const KickReference reference = hold_path_over_ground(planned, start_in_support);
  const Vector2d com_velocity = (planned.com - last_planned_com_) / context.dt;
  last_planned_com_ = planned.com;
  const Vector2d zmp_offset = calc_zmp_offset(state, reference, com_velocity);

  pose_.turn_torso(reference, hold_path_over_ground(trajectory_.impact(), start_in_support));
  const Isometry3d torso = pose_.torso_in_support(reference);

  // Keeps the old angles, to compute velocities by differences, rad/s.
  std::vector<double> velocity = reference_position_;
  pose_.write_legs(reference, reference_position_);
  for (size_t i = 0; i < velocity.size(); ++i) {
    velocity[i] = (reference_position_[i] - velocity[i]) / context.dt;
  }
  kinematics_.update(reference_position_);
  pose_.update_com(kinematics_.center_of_mass(), context.dt);
  gyroscope_.update(state.angular_velocity_torso, context.dt);

  const std::array<FootLoad, 2> loads = calc_loads(reference, torso, zmp_offset);
  const Vector3d up = torso.linear().transpose() * Vector3d::UnitZ();
  write_targets(feedforward_.calc_torques(kinematics_, up, loads), velocity, targets);
}

// Proportional feedback of the divergent component of motion, m: the CoP goes beyond the DCM's
// error, which lets the error decay; bounded by the reach on the sole.
Vector2d KickMotion::calc_zmp_offset(const RobotState& state, const KickReference& reference,
                                     const Vector2d& com_velocity) const {
  const double omega = std::sqrt(kGravity / pose_.com_height());
  const Vector2d dcm = state.center_of_mass_in_odometry.head<2>() +
                       state.center_of_mass_velocity_in_odometry.head<2>() / omega;
  const Vector2d planned_dcm = reference.com + com_velocity / omega;
  const Vector2d error = support_in_odometry(state).inverse() * dcm - planned_dcm;
  return (kick_->balance_gain * error).cwiseMax(-kick_->zmp_reach).cwiseMin(kick_->zmp_reach);
}

std::array<FootLoad, 2> KickMotion::calc_loads(const KickReference& reference,
                                               const Isometry3d& torso,
                                               const Vector2d& zmp_offset) const {
  const bool is_airborne = reference.foot.z() > 0;
  const double foot_y = reference.foot.y();
  // In double support the CoM's place between the feet gives their load ratio.
  const double load_ratio = is_airborne ? 0.0 : std::clamp(reference.com.y() / foot_y, 0.0, 1.0);
  // The robot stands on its load only: no horizontal force, in contrast to the walk's pendulum.
  const Vector3d weight =
      torso.linear().transpose() * Vector3d(0, 0, model_->total_mass() * kGravity);
  const Isometry3d support_in_torso = torso.inverse();
  // The commanded CoP is under the commanded CoM: the pose is nearly static.
  const double zmp_x = reference.com.x() + zmp_offset.x();
  const double zmp_y = (is_airborne ? reference.com.y() : 0.0) + zmp_offset.y();
  const FootLoad support{(1 - load_ratio) * weight, support_in_torso * Vector3d(zmp_x, zmp_y, 0)};
  const FootLoad kicking{load_ratio * weight,
                         support_in_torso * Vector3d(reference.foot.x() + zmp_x, foot_y, 0)};
  return is_left_ ? std::array{kicking, support} : std::array{support, kicking};
}

void KickMotion::write_targets(const std::vector<double>& torque,
                               const std::vector<double>& velocity, JointTargets& targets) const {
  const LegKinematics& legs = pose_.legs();
  // Feedback of the angular velocity at the ankle of the support leg.
  std::vector<double> balance(velocity.size(), 0.0);
  const Leg support = is_left_ ? Leg::kRight : Leg::kLeft;
  const LegRoles& roles = legs.roles(support);
  const auto add = [&](int role, double angle) {
    if (role >= 0) balance[legs.motors(support)[role]] = roles.sign[role] * angle;
  };
  add(roles.ankle_pitch, gait_->orientation.gyro_ankle_pitch * gyroscope_.value().y());
  add(roles.ankle_roll, gait_->orientation.gyro_ankle_roll * gyroscope_.value().x());
  const double fade =
      smooth_step(time_ / kFade) * smooth_step((trajectory_.duration() - time_) / kFade);
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    for (const int motor : legs.motors(leg)) {
      targets.position[motor] =
          reference_position_[motor] +
          fade * (balance[motor] + feedforward_.calc_offset(motor, torque[motor], velocity[motor],
                                                            gait_->servo.velocity_scale));
    }
  }
}

bool KickMotion::can_be_replaced() const {
  // Within the trajectory the robot stands on one foot.
  return is_standing_up_ ? stand_up_->can_be_replaced()
                         : time_ <= 0 || time_ >= trajectory_.duration();
}

void KickMotion::finish() {
  is_finishing_ = true;
  if (is_standing_up_) stand_up_->finish();
}

double KickMotion::progress() const {
  return std::clamp(time_ / trajectory_.duration(), 0.0, 1.0);
}

}  // namespace nao::motion
