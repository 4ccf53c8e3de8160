#include "daemons/motion/generators/kick_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "daemons/motion/generators/walk_motion.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kRateTimeConstant = 0.015;  // s, of the gyroscope
// The torso makes room for the leg's mass, but does not follow every swing of it, s.
constexpr double kComTimeConstant = 0.05;
// Farthest that the zero moment point may be steered from the mass, m: a sole's half, less a
// margin.
constexpr double kReachForward = 0.045;
constexpr double kReachSideways = 0.02;

double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

}  // namespace

std::optional<Reason> KickMotion::find_obstacle(const Kick& kick, bool is_left,
                                                const Vector2d& ball) {
  const Vector2d best(kick.ball.x(), (is_left ? 1 : -1) * kick.ball.y());
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
      strength_(std::clamp(std::isnan(strength) ? kick.strength : strength, 0.0, 1.0)),
      legs_(model),
      feedforward_(model),
      kinematics_(model),
      phases_(kick.phases) {
  const double aside = std::isnan(ball.y()) ? 0 : side() * ball.y() - kick.ball.y();
  for (Kick::Phase& phase : phases_) {
    if (phase.name == "strike") {
      phase.duration =
          kick.strike_duration[0] + strength_ * (kick.strike_duration[1] - kick.strike_duration[0]);
    }
    // The foot swings in the plane that the ball lies in.
    if (phase.foot.z() > 0) phase.foot.y() += aside;
    duration_ += phase.duration;
  }
}

void KickMotion::start(const MotionContext& context, const JointTargets& targets) {
  is_standing_up_ = !is_walking_stance(context.model, targets.position);
  if (is_standing_up_) {
    stand_up_->start(context, targets);
  } else {
    start_kick(targets);
  }
}

void KickMotion::start_kick(const JointTargets& targets) {
  time_ = 0;
  kinematics_.update(targets.position);
  const Isometry3d& support = is_left_ ? kinematics_.right_sole() : kinematics_.left_sole();
  const Isometry3d& other = is_left_ ? kinematics_.left_sole() : kinematics_.right_sole();
  start_torso_ = support.inverse();
  const Isometry3d foot = start_torso_ * other;
  kick_heading_ = std::atan2(foot.linear()(1, 0), foot.linear()(0, 0));
  com_in_torso_ = kinematics_.center_of_mass();
  const Vector3d mass = start_torso_ * com_in_torso_;
  height_ = mass.z();
  start_reference_.mass = {mass.x(), side() * mass.y()};
  start_reference_.foot = {foot.translation().x(), side() * foot.translation().y(),
                           foot.translation().z()};
  start_reference_.pitch = 0;
  // It ends where it began.
  phases_.back().mass = start_reference_.mass;
  phases_.back().foot = start_reference_.foot;
  reference_position_ = targets.position;
}

KickMotion::Reference KickMotion::reference_at(double time) const {
  Reference from = start_reference_;
  for (const Kick::Phase& phase : phases_) {
    if (time < phase.duration) {
      const double s = smooth_step(time / phase.duration);
      return {from.mass + s * (phase.mass - from.mass), from.foot + s * (phase.foot - from.foot),
              from.pitch + s * (phase.pitch - from.pitch)};
    }
    time -= phase.duration;
    from = {phase.mass, phase.foot, phase.pitch};
  }
  return from;
}

Isometry3d KickMotion::torso_for(const Reference& reference) const {
  Isometry3d torso = start_torso_;
  const Vector3d offset = torso.linear() * com_in_torso_;
  torso.translation().x() = reference.mass.x() - offset.x();
  torso.translation().y() = side() * reference.mass.y() - offset.y();
  return torso;
}

std::vector<double> KickMotion::solve(const Reference& reference, const Isometry3d& torso,
                                      const std::vector<double>& position) const {
  const Isometry3d support = torso.inverse();
  Isometry3d foot = Isometry3d::Identity();
  foot.translation() << reference.foot.x(), side() * reference.foot.y(), reference.foot.z();
  foot.linear() = (AngleAxisd(kick_heading_, Vector3d::UnitZ()) *
                   AngleAxisd(reference.pitch, Vector3d::UnitY()))
                      .toRotationMatrix();
  foot = support * foot;
  const LegsSolution solution =
      legs_.solve_both(is_left_ ? foot : support, is_left_ ? support : foot, is_left_ ? 0.0 : 1.0);
  std::vector<double> result = position;
  legs_.write(Leg::kLeft, solution.left, result);
  legs_.write(Leg::kRight, solution.right, result);
  return result;
}

MotionGenerator::Phase KickMotion::step(const MotionContext& context, JointTargets& targets) {
  if (is_standing_up_) {
    const Phase phase = stand_up_->step(context, targets);
    if (phase == Phase::kFailed) reason_ = stand_up_->reason();
    if (phase != Phase::kDone) return phase;
    is_standing_up_ = false;
    if (is_finishing_) return Phase::kDone;
    start_kick(targets);
    return Phase::kRunning;
  }
  time_ += context.dt;
  follow(context, reference_at(time_), targets);
  return time_ < duration_ ? Phase::kRunning : Phase::kDone;
}

void KickMotion::follow(const MotionContext& context, const Reference& reference,
                        JointTargets& targets) {
  const double dt = context.dt;
  const Isometry3d torso = torso_for(reference);
  const std::vector<double> position = solve(reference, torso, reference_position_);
  std::vector<double> velocity(position.size());
  for (size_t i = 0; i < position.size(); ++i) {
    velocity[i] = (position[i] - reference_position_[i]) / dt;
  }
  reference_position_ = position;
  kinematics_.update(position);
  com_in_torso_ +=
      std::min(1.0, dt / kComTimeConstant) * (kinematics_.center_of_mass() - com_in_torso_);

  // Measured: CoM over the support sole, with its velocity, against the reference.
  const RobotState& state = context.state;
  const Pose2 sole =
      Pose2::from(is_left_ ? state.right_sole_in_odometry : state.left_sole_in_odometry);
  const double omega = std::sqrt(kGravity / height_);
  const Vector2d divergent = state.center_of_mass_in_odometry.head<2>() +
                             state.center_of_mass_velocity_in_odometry.head<2>() / omega;
  const Vector2d mass(reference.mass.x(), side() * reference.mass.y());
  const Vector2d error = sole.inverse() * divergent - mass;
  const Vector2d reach(kReachForward, kReachSideways);
  const Vector2d steer = (kick_->balance_gain * error).cwiseMax(-reach).cwiseMin(reach);
  rate_ += std::min(1.0, dt / kRateTimeConstant) * (state.angular_velocity_torso - rate_);

  const double foot_y = side() * reference.foot.y();
  const double other_share = reference.foot.z() > 0 ? 0.0 : std::clamp(mass.y() / foot_y, 0.0, 1.0);
  const Vector3d force =
      torso.linear().transpose() * Vector3d(0, 0, model_->total_mass() * kGravity);
  const Isometry3d to_torso = torso.inverse();
  const double here_y = reference.foot.z() > 0 ? mass.y() : 0.0;
  const FootLoad support{(1 - other_share) * force,
                         to_torso * Vector3d(mass.x() + steer.x(), here_y + steer.y(), 0)};
  const FootLoad other{other_share * force,
                       to_torso * Vector3d(reference.foot.x() + mass.x() + steer.x(), foot_y, 0)};
  const std::array<FootLoad, 2> loads =
      is_left_ ? std::array<FootLoad, 2>{other, support} : std::array<FootLoad, 2>{support, other};
  const Vector3d up = torso.linear().transpose() * Vector3d::UnitZ();
  const std::vector<double> torque = feedforward_.calc_torques(kinematics_, up, loads);

  // What the servos need fades in at the start and out at the end, where the targets are angles.
  constexpr double kFade = 0.3;
  const double share = smooth_step(time_ / kFade) * smooth_step((duration_ - time_) / kFade);
  std::vector<double> balance(position.size(), 0.0);
  const auto& ankle = legs_.motors(is_left_ ? Leg::kRight : Leg::kLeft);
  balance[ankle[4]] = gait_->orientation.gyro_ankle_pitch * rate_.y();
  balance[ankle[5]] = gait_->orientation.gyro_ankle_roll * rate_.x();
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    for (const int motor : legs_.motors(leg)) {
      targets.position[motor] =
          position[motor] +
          share * (balance[motor] + feedforward_.calc_offset(motor, torque[motor], velocity[motor],
                                                             gait_->servo.velocity_scale));
    }
  }
}

bool KickMotion::can_be_replaced() const {
  return is_standing_up_ ? stand_up_->can_be_replaced() : time_ <= 0 || time_ >= duration_;
}

void KickMotion::finish() {
  is_finishing_ = true;
  if (is_standing_up_) stand_up_->finish();
}

double KickMotion::progress() const {
  return duration_ > 0 ? std::clamp(time_ / duration_, 0.0, 1.0) : 1.0;
}

}  // namespace nao::motion
