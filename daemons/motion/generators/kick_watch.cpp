#include "daemons/motion/generators/kick_watch.h"

#include <cmath>

#include "common/constants.h"

namespace nao::motion {
namespace {

// Age up to which a sighting tells where the ball is, s. Chosen: a ball that rolls at 0.3 m/s would
// have left the kick's reach.
constexpr double kFreshTime = 0.5;
// Time after the strike from which on the ball is taken as moved or not, s. Chosen: a ball at 0.5
// m/s has gone 0.15 m.
constexpr double kSettleTime = 0.3;
// Distance from which on the ball has moved, m, and from which on its direction is told, m. Chosen:
// nao-vision's error at the robot's feet is 1 cm, odometry's during a kick 2 cm.
constexpr double kMoved = 0.1;
constexpr double kDirectionDistance = 0.3;
// Time before the end of the strike from which on the joints are recorded, s. Chosen: longer than
// any strike.
constexpr double kRecordTime = 1.2;
// And after it, s. Chosen: the ball leaves the foot within 0.05 s.
constexpr double kRecordAfter = 0.3;

}  // namespace

Pose2 KickWatch::stance_of(const RobotState& state) {
  const Eigen::Vector3d middle = 0.5 * (state.left_sole_in_odometry.translation() +
                                        state.right_sole_in_odometry.translation());
  return {middle.head<2>(), heading_of(state.torso_in_odometry.linear())};
}

std::optional<Eigen::Vector2d> KickWatch::find_ball(const MotionContext& context) {
  const SeenBall* ball = context.ball;
  if (ball == nullptr) return std::nullopt;
  const double age = static_cast<double>(context.state.utime - ball->utime) * 1e-6;
  if (age > kFreshTime) return std::nullopt;
  return stance_of(context.state).inverse() * ball->position_in_odometry;
}

void KickWatch::start(const MotionContext& context, double strike_end) {
  strike_end_ = strike_end;
  heading_ = stance_of(context.state).heading;
  before_.reset();
  after_.reset();
  struck_utime_ = 0;
  samples_.clear();
  if (find_ball(context)) before_ = context.ball->position_in_odometry;
}

void KickWatch::step(const MotionContext& context, double time) {
  if (impact_ != nullptr && time > strike_end_ - kRecordTime && time < strike_end_ + kRecordAfter) {
    const Leg leg = is_left_ ? Leg::kLeft : Leg::kRight;
    const Leg support = is_left_ ? Leg::kRight : Leg::kLeft;
    const auto hip = [&](Leg side) { return legs_->motors(side)[legs_->roles(side).hip_pitch]; };
    const auto knee = [&](Leg side) { return legs_->motors(side)[legs_->roles(side).knee]; };
    const Sensors& sensors = context.sensors;
    const Eigen::Vector3d& rate = sensors.gyroscope_torso;
    const Eigen::Isometry3d& sole =
        is_left_ ? context.kinematics.left_sole() : context.kinematics.right_sole();
    samples_.push_back(
        {time,
         sole.translation().x(),
         {sensors.velocity[hip(leg)], sensors.velocity[knee(leg)], sensors.torque[hip(leg)],
          sensors.torque[knee(leg)], rate.y(), is_left_ ? rate.z() : -rate.z(),
          sensors.torque[hip(support)], sensors.torque[knee(support)]}});
  }
  if (time < strike_end_ + kSettleTime) return;
  if (struck_utime_ == 0) struck_utime_ = context.state.utime;
  if (context.ball != nullptr && context.ball->utime >= struck_utime_) {
    after_ = context.ball->position_in_odometry;
  }
}

KickWatch::Verdict KickWatch::judge() const {
  if (before_ && after_) {
    const Eigen::Vector2d way = *after_ - *before_;
    if (way.norm() < kMoved) return {true, Reason("kick-missed")};
    if (way.norm() < kDirectionDistance) return {};
    const double off = wrapped(std::atan2(way.y(), way.x()) - heading_);
    return {false, Reason("kick-direction", {std::to_string(std::lround(off / kDegree))})};
  }
  const std::optional<bool> is_hit = impact_ != nullptr ? impact_->judge(samples_) : std::nullopt;
  if (!is_hit) return {false, Reason("kick-unobserved")};
  if (!*is_hit) return {true, Reason("kick-missed")};
  return {};
}

}  // namespace nao::motion
