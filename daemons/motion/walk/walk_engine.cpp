#include "daemons/motion/walk/walk_engine.h"

#include <algorithm>
#include <cmath>

#include "daemons/motion/walk/kick_approach.h"

namespace nao::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;

// Footprints that are looked ahead: what the fifth does to the present step is below a millimetre.
constexpr int kNumPlannedSteps = 5;
// Nearer to the end of a step than this, neither its time nor the zero moment point is steered, s:
// the answer would come too late, and small errors would ask for the moon.
constexpr double kSteeringHorizon = 0.05;
// Both feet stand side by side if the one is within this of its place beside the other, m and rad.
constexpr double kSquareDistance = 0.02;
constexpr double kSquareTurn = 0.06;
// If the walk has not ended after this many steps that should have ended it, it marches on the spot
// until the feet are side by side: slower, and sure.
constexpr int kMostEndingSteps = 3;
// A foot that met the ground too high or too low comes back to level in this time, s.
constexpr double kHeightTimeConstant = 0.1;
// A foot that has not met the ground in time goes on down, m/s, as far as m, for s at most.
constexpr double kReachSpeed = 0.08;
constexpr double kReachDepth = 0.01;
constexpr double kReachTime = 0.06;
// A foot may count as landed from this share of its step on.
constexpr double kEarliestTouchdown = 0.6;
// Greatest speed of the torso on the way to its walking height, m/s, and of arms, rad/s; shortest
// time, s.
constexpr double kLoweringSpeed = 0.08;
constexpr double kArmSpeed = 2.0;
constexpr double kShortestLowering = 0.3;
// The gyroscope is smoothed with this time constant, s.
constexpr double kRateTimeConstant = 0.015;
constexpr double kMaxBias = 0.03;  // m
// The plan goes on by this much in a tick at most, s. When motion was kept from running for some
// ticks the servos have held their targets: to go on from there keeps the robot on its feet three
// times as often as to catch up with a jump (nao-trial walk --vx 0.3 --late 0.03).
constexpr double kLongestAdvance = 0.01;
// A kick whose ball has not been reached after this is given up, s.
constexpr double kKickPatience = 10;
// How far the swing of a kick is moved to where the ball lies, m ahead and aside.
const Vector2d kKickReach(0.03, 0.02);
constexpr double kMaxTilt = 0.35;  // rad; beyond this the feedback's small angles mean nothing

/** From 0 to 1 with zero velocity and acceleration at both ends. */
double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (6 * s - 15));
}

Isometry3d in_space(const Pose2& pose, double height) {
  Isometry3d result = Isometry3d::Identity();
  result.translation() << pose.position, height;
  result.linear() = AngleAxisd(pose.heading, Vector3d::UnitZ()).toRotationMatrix();
  return result;
}

Vector2d clamp_to(const Vector2d& point, const Vector2d& lower, const Vector2d& upper) {
  return point.cwiseMax(lower).cwiseMin(upper);
}

}  // namespace

WalkEngine::WalkEngine(const RobotModel& model, const Gait& gait, const Posture& end_posture)
    : model_(&model),
      gait_(&gait),
      end_posture_(&end_posture),
      legs_(model),
      planner_(model, gait),
      feedforward_(model),
      reference_kinematics_(model) {
  const auto add_arm = [&](const char* prefix, double mirrored) {
    const auto add = [&](const char* joint, double angle, double swing) {
      const int motor = model.find_motor(std::string(prefix) + joint);
      if (motor >= 0) arms_.push_back({motor, angle, swing});
    };
    add("ShoulderPitch", gait.shoulder_pitch, -mirrored * gait.arm_swing);
    add("ShoulderRoll", mirrored * gait.shoulder_roll, 0);
    add("ElbowYaw", mirrored * gait.elbow_yaw, 0);
    add("ElbowRoll", mirrored * gait.elbow_roll, 0);
  };
  add_arm("L", 1);
  add_arm("R", -1);
  reference_kinematics_.update(end_posture.position);
  const Isometry3d to_sole = reference_kinematics_.left_sole().inverse();
  stand_lead_ = (to_sole * reference_kinematics_.center_of_mass()).x() - gait.zmp_forward;
}

void WalkEngine::start(const JointTargets& targets) {
  stage_ = Stage::kLowering;
  is_ending_ = false;
  is_capturing_ = false;
  num_ending_steps_ = 0;
  kick_state_ = KickState::kNone;
  is_kick_step_ = false;
  velocity_.setZero();
  step_velocity_.setZero();
  bias_.fill(Vector2d::Zero());
  deviation_.setZero();
  time_ = 0;
  support_is_left_ = true;
  support_height_ = 0;
  support_spread_ = {};
  planned_.clear();
  start_position_ = targets.position;

  reference_kinematics_.update(targets.position);
  const Isometry3d torso_in_support = reference_kinematics_.left_sole().inverse();
  const Isometry3d other = torso_in_support * reference_kinematics_.right_sole();
  swing_.start(Pose2::from(other), 0);
  start_torso_ = torso_in_support;
  mass_centre_in_torso_ = reference_kinematics_.center_of_mass();
  reference_ = {middle(), Vector2d::Zero()};
  zmp_ = reference_.position;
  height_ = (torso_in_support * mass_centre_in_torso_).z();
  omega_ = std::sqrt(kGravity / height_);
  wished_position_ = targets.position;
  wished_velocity_.assign(targets.position.size(), 0.0);
  rate_.setZero();
  has_estimate_ = false;

  double way =
      std::abs(start_torso_.translation().z() - gait_->hip_height + legs_.hip(Leg::kLeft).z()) /
      kLoweringSpeed;
  for (const ArmJoint& joint : arms_) {
    way = std::max(way, std::abs(joint.angle - start_position_[joint.motor]) / kArmSpeed);
  }
  // A smooth step's greatest speed is 1.875 times its mean.
  duration_ = std::max(kShortestLowering, 1.875 * way);
  share_ = 0;
  start_offset_.assign(targets.position.size(), 0.0);
  const std::vector<double> posture = pose_joints();
  for (size_t i = 0; i < posture.size(); ++i) start_offset_[i] = start_position_[i] - posture[i];
  wished_position_ = posture;
}

bool WalkEngine::step(const RobotState& state, const Kinematics& measured, double dt,
                      JointTargets& targets) {
  if (stage_ == Stage::kDone) return false;
  dt = std::min(dt, kLongestAdvance);
  measure(state, measured, dt);
  time_ += dt;
  kick_time_ += dt;
  switch (stage_) {
    case Stage::kLowering:
      step_lowering();
      break;
    case Stage::kStarting:
      step_starting(dt);
      break;
    case Stage::kStepping:
      step_stepping(dt);
      break;
    default:
      step_stopping(dt);
      break;
  }
  if (stage_ == Stage::kRaising) step_raising();
  follow_reference(dt, targets);
  if (stage_ == Stage::kStopping && time_ >= gait_->stop_duration) begin_raising();
  return stage_ != Stage::kDone;
}

void WalkEngine::measure(const RobotState& state, const Kinematics& measured, double dt) {
  const Matrix3d& R_OT = state.torso_in_odometry.linear();
  soles_in_odometry_ = {Pose2::from(state.left_sole_in_odometry),
                        Pose2::from(state.right_sole_in_odometry)};
  support_in_odometry_ = soles_in_odometry_[support_is_left_ ? 0 : 1];
  const Vector3d mass_centre = state.torso_in_odometry * measured.center_of_mass();
  const Pose2 to_support = support_in_odometry_.inverse();
  const Vector2d position = to_support * Vector2d(mass_centre.head<2>());
  Vector2d pressure = to_support * state.center_of_pressure_in_odometry;
  if (!pressure.allFinite()) pressure = zmp_;
  if (!has_estimate_) {
    estimator_.reset(position);
    has_estimate_ = true;
  } else if (has_changed_support_) {
    estimator_.change_frame(position, support_in_odometry_.heading - last_support_heading_);
  } else {
    estimator_.update(position, pressure, omega_, dt);
  }
  has_changed_support_ = false;
  last_support_heading_ = support_in_odometry_.heading;

  const double heading = std::atan2(R_OT(1, 0), R_OT(0, 0));
  torso_heading_ = heading;
  const Matrix3d R_HT = AngleAxisd(-heading, Vector3d::UnitZ()).toRotationMatrix() * R_OT;
  tilt_ << std::atan2(R_HT(2, 1), R_HT(2, 2)), std::asin(std::clamp(-R_HT(2, 0), -1.0, 1.0)), 0;
  tilt_.y() -= wished_pitch_;
  tilt_ = tilt_.cwiseMax(-kMaxTilt).cwiseMin(kMaxTilt);
  rate_ += std::min(1.0, dt / kRateTimeConstant) * (state.angular_velocity_torso - rate_);
  swing_force_ = support_is_left_ ? state.right_foot_force : state.left_foot_force;
  predicted_ = advance(estimator_.state(), zmp_, omega_, gait_->reaction_time);
}

Vector2d WalkEngine::middle() const {
  return 0.5 * (nominal_zmp(support_is_left_) + swing_.pose() * nominal_zmp(!support_is_left_));
}

void WalkEngine::step_lowering() {
  share_ = smooth_step(time_ / duration_);
  reference_ = {middle(), Vector2d::Zero()};
  zmp_ = reference_.position;
  other_share_ = 0.5;
  if (time_ < duration_) return;
  if (is_ending_) {
    begin_raising();
  } else {
    begin_starting();
  }
}

void WalkEngine::begin_starting() {
  stage_ = Stage::kStarting;
  time_ = 0;
  duration_ = gait_->start_duration;
  share_ = 1;
  // The first step is taken with the foot that leads.
  const Vector3d wished = planner_.clip_velocity(is_ending_ ? Vector3d::Zero() : wished_);
  const double lead = std::abs(wished.y()) > 0.02 ? wished.y() : wished.z();
  const bool swing_is_left = lead > 0;
  if (swing_is_left == support_is_left_) exchange_feet();
  plan_steps();
}

void WalkEngine::plan_steps() {
  if (!is_ending_ || num_ending_steps_ > kMostEndingSteps) {
    plan_ahead(kNumPlannedSteps);
    return;
  }
  plan_ahead(1);
  if (!can_end_square()) plan_ahead(2);
}

void WalkEngine::plan_ahead(int num_steps) {
  planned_ = planner_.plan(support_is_left_, support_spread_, step_velocity_, gait_->step_duration,
                           num_steps);
  foothold_ = planned_.front().pose;
  // Backwards from rest between the last two feet: where the divergent component must be when each
  // step begins.
  std::vector<Vector2d> points = {nominal_zmp(support_is_left_)};
  for (const PlannedStep& step : planned_) points.push_back(step.pose * nominal_zmp(step.is_left));
  const double decay = std::exp(-omega_ * gait_->step_duration);
  Vector2d divergent = 0.5 * (points[num_steps - 1] + points[num_steps]);
  if (is_ending_) divergent.x() += stand_lead_;
  for (int i = num_steps - 1; i > 0; --i) {
    divergent = points[i] + decay * (divergent - points[i]);
  }
  divergent_goal_ = divergent;
  divergent_start_ = points[0] + decay * (divergent - points[0]);
}

Vector2d WalkEngine::steer_zmp(double remaining) const {
  const Vector2d nominal = nominal_zmp(support_is_left_);
  const Vector2d steer =
      steering_point(reference_.divergent(omega_), divergent_goal_, omega_, remaining);
  const double reach = gait_->zmp_reach_sideways;
  return clamp_to(nominal + gait_->zmp_gain * (steer - nominal),
                  nominal - Vector2d(gait_->zmp_reach_backward, reach),
                  nominal + Vector2d(gait_->zmp_reach_forward, reach));
}

bool WalkEngine::can_end_square() const {
  const double remaining = std::max(duration_ - time_, kSteeringHorizon);
  const Vector2d zmp = steer_zmp(remaining);
  const Vector2d end = zmp + std::exp(omega_ * remaining) * (reference_.divergent(omega_) - zmp);
  return (end - divergent_goal_).norm() < kSquareDistance / 2;
}

void WalkEngine::step_starting(double dt) {
  give_way(dt);
  const Vector2d here = nominal_zmp(support_is_left_);
  const Vector2d there = swing_.pose() * nominal_zmp(!support_is_left_);
  const Vector2d divergent = reference_.divergent(omega_);
  const double remaining = std::max(duration_ - time_, kSteeringHorizon);
  const Vector2d reach(gait_->zmp_reach_backward, 0);
  const Vector2d reach_up(gait_->zmp_reach_forward, 0);
  zmp_ = clamp_to(steering_point(divergent, divergent_start_, omega_, remaining),
                  here.cwiseMin(there) - reach, here.cwiseMax(there) + reach_up);
  share_by_pressure();
  reference_ = advance(reference_, zmp_, omega_, dt);
  const double left_to_go = side() * (divergent_start_.y() - reference_.divergent(omega_).y());
  if (left_to_go > 0 && time_ < 4 * duration_) return;
  path_.reset(body_in_odometry());
  begin_step();
}

void WalkEngine::begin_step() {
  stage_ = Stage::kStepping;
  time_ = 0;
  duration_ = gait_->step_duration;
  num_ending_steps_ = is_ending_ ? num_ending_steps_ + 1 : 0;
  const Vector3d wished = planner_.clip_velocity(choose_velocity());
  velocity_ = is_ending_ ? wished : planner_.ramp_velocity(velocity_, wished);
  step_velocity_ = calc_step_velocity();
  is_capturing_ = is_ending_;
  plan_steps();
}

void WalkEngine::kick(bool with_left, const std::optional<Vector2d>& ball) {
  kick_state_ = KickState::kPending;
  kicks_with_left_ = with_left;
  ball_ = ball;
  kick_time_ = 0;
}

Vector3d WalkEngine::choose_velocity() {
  if (is_ending_) return Vector3d::Zero();
  if (kick_state_ != KickState::kPending || is_kick_step_) return wished_;
  if (ball_) return approach_ball(wished_);
  if (kicks_with_left_ != support_is_left_) begin_kick(Vector2d::Zero());
  return wished_;
}

Vector3d WalkEngine::approach_ball(const Vector3d& wished) {
  if (kick_time_ > kKickPatience) {
    kick_state_ = KickState::kMissed;
    return wished;
  }
  const double foot = (kicks_with_left_ ? 0.5 : -0.5) * gait_->foot_separation;
  const Vector2d best(gait_->kick_distance - gait_->turn_centre, foot);
  const Vector2d way = body_in_odometry().inverse() * *ball_ - best;
  const bool kicks_next = kicks_with_left_ != support_is_left_;
  const KickApproach approach =
      plan_kick_approach(way, kicks_next, wished.head<2>(), gait_->step_duration);
  if (approach.num_steps > 0) return {approach.velocity.x(), approach.velocity.y(), 0};
  begin_kick(way);
  return {wished.x(), 0, 0};
}

void WalkEngine::begin_kick(const Vector2d& off) {
  is_kick_step_ = true;
  kick_offset_ = clamp_to(off, -kKickReach, kKickReach);
}

Pose2 WalkEngine::middle_in_odometry() const {
  return {0.5 * (soles_in_odometry_[0].position + soles_in_odometry_[1].position), torso_heading_};
}

void WalkEngine::begin_capture() {
  is_capturing_ = true;
  if (is_kick_step_ || duration_ - time_ < kSteeringHorizon) return;
  velocity_.setZero();
  step_velocity_.setZero();
  plan_steps();
}

Pose2 WalkEngine::body_in_odometry() const {
  return soles_in_odometry_[support_is_left_ ? 0 : 1] *
         planner_.foot_in_body(support_is_left_, support_spread_).inverse();
}

Pose2 WalkEngine::standing_body(const RobotState& state) const {
  const Pose2 left = Pose2::from(state.left_sole_in_odometry);
  const Pose2 right = Pose2::from(state.right_sole_in_odometry);
  const Pose2 middle{0.5 * (left.position + right.position),
                     left.heading + 0.5 * wrapped(right.heading - left.heading)};
  return middle * Pose2{{gait_->turn_centre, 0}, 0};
}

Vector3d WalkEngine::calc_step_velocity() {
  const bool seeks_ball = kick_state_ == KickState::kPending && ball_;
  if (velocity_.isZero(0) || is_capturing_ || seeks_ball) {
    path_.reset(body_in_odometry());
    return velocity_;
  }
  return velocity_ + path_.correct(body_in_odometry(), gait_->path_gain);
}

void WalkEngine::step_stepping(double dt) {
  if (is_ending_ && !is_capturing_) begin_capture();
  path_.advance(velocity_, dt);
  give_way(dt);
  adapt_duration();
  const double remaining = duration_ - time_;
  const Vector2d error = predicted_.divergent(omega_) - reference_.divergent(omega_);
  Vector2d divergent = reference_.divergent(omega_);
  if (remaining > kSteeringHorizon) {
    zmp_ = steer_zmp(remaining);
    divergent += gait_->step_gain * error;
    const Vector2d end = zmp_ + std::exp(omega_ * remaining) * (divergent - zmp_);
    const Pose2& planned = planned_.front().pose;
    deviation_ = end - divergent_goal_ - bias();
    foothold_ =
        planner_.clip_step({planned.position + deviation_, planned.heading}, !support_is_left_);
  }
  reference_ = advance(reference_, zmp_, omega_, dt);

  // Weight is handed over around the time of the change: half of it before, half after.
  const double half = gait_->double_support / 2;
  const double air_end = duration_ - half;
  other_share_ = 0;
  if (half > 0 && time_ < half) other_share_ = 0.5 * (1 - time_ / half);
  if (half > 0 && time_ > air_end) other_share_ = std::min(0.5, 0.5 * (time_ - air_end) / half);
  if (time_ >= half) {
    const double phase = (time_ - half) / (air_end - half);
    const double arrival = half + gait_->swing_arrival * (air_end - half) - time_;
    swing_.step(foothold_, arrival, phase, gait_->step_height, dt);
  }
  support_height_ -= std::min(1.0, dt / kHeightTimeConstant) * support_height_;

  const double weight = model_->total_mass() * kGravity;
  const bool is_down = swing_force_ > gait_->touchdown_share * weight;
  const bool is_late = time_ >= duration_ - 1e-9;
  if (is_late && !is_down && time_ < duration_ + kReachTime) {
    swing_.lower(std::min(kReachSpeed * dt, std::max(0.0, kReachDepth + swing_.height())));
    return;
  }
  if (is_late || (is_down && time_ > kEarliestTouchdown * duration_)) change_support();
}

void WalkEngine::adapt_duration() {
  if (gait_->timing_gain <= 0 || duration_ - time_ < kSteeringHorizon) return;
  // Seen sideways, towards the swinging foot: the step ends when the divergent component is where
  // the next step wants it.
  const Vector2d error = predicted_.divergent(omega_) - reference_.divergent(omega_);
  const Vector2d divergent = reference_.divergent(omega_) + gait_->step_gain * error;
  const double zmp = -side() * nominal_zmp(support_is_left_).y();
  const double now = -side() * divergent.y() - zmp;
  const double goal = -side() * divergent_goal_.y() - zmp;
  double ideal = gait_->max_step_duration;
  if (now > 0 && goal > now) ideal = time_ + std::log(goal / now) / omega_;
  if (now > 0 && goal <= now) ideal = time_;
  const double wished = gait_->step_duration + gait_->timing_gain * (ideal - gait_->step_duration);
  duration_ = std::clamp(wished, gait_->min_step_duration, gait_->max_step_duration);
  duration_ = std::max(duration_, time_ + kSteeringHorizon);
}

void WalkEngine::exchange_feet() {
  const Pose2 other = swing_.pose();
  const Pose2 to_other = other.inverse();
  reference_.position = to_other * reference_.position;
  reference_.velocity = Eigen::Rotation2Dd(-other.heading) * reference_.velocity;
  zmp_ = to_other * zmp_;
  const double height = swing_.height();
  swing_.start(to_other, support_height_);
  support_height_ = height;
  support_is_left_ = !support_is_left_;
  has_changed_support_ = true;
}

void WalkEngine::change_support() {
  if (is_kick_step_) kick_state_ = KickState::kStruck;
  is_kick_step_ = false;
  bias() += gait_->bias_gain * deviation_;
  bias() = clamp_to(bias(), Vector2d::Constant(-kMaxBias), Vector2d::Constant(kMaxBias));
  support_spread_ = planner_.spread_for(step_velocity_);
  exchange_feet();
  const Pose2 square = planner_.foot_in_body(support_is_left_, {}).inverse() *
                       planner_.foot_in_body(!support_is_left_, {});
  const bool is_square = (swing_.pose().position - square.position).norm() < kSquareDistance &&
                         std::abs(wrapped(swing_.pose().heading)) < kSquareTurn;
  if (is_ending_ && velocity_.isZero(1e-6) && is_square) {
    stage_ = Stage::kStopping;
    time_ = 0;
    planned_.clear();
  } else {
    begin_step();
  }
}

void WalkEngine::step_stopping(double dt) {
  give_way(dt);
  const Vector2d here = nominal_zmp(support_is_left_);
  const Vector2d there = swing_.pose() * nominal_zmp(!support_is_left_);
  const Vector2d reach(gait_->zmp_reach_backward, 0);
  const Vector2d reach_up(gait_->zmp_reach_forward, 0);
  constexpr double kHorizon = 0.2;
  zmp_ = clamp_to(steering_point(reference_.divergent(omega_), rest(), omega_, kHorizon),
                  here.cwiseMin(there) - reach, here.cwiseMax(there) + reach_up);
  share_by_pressure();
  reference_ = advance(reference_, zmp_, omega_, dt);
  const double share = std::min(1.0, dt / kHeightTimeConstant);
  support_height_ -= share * support_height_;
  swing_.lower(share * swing_.height());
}

void WalkEngine::begin_raising() {
  stage_ = Stage::kRaising;
  time_ = 0;
  velocity_.setZero();
}

void WalkEngine::step_raising() {
  share_ = 1 - smooth_step(time_ / gait_->raise_duration);
  if (time_ >= gait_->raise_duration) stage_ = Stage::kDone;
}

void WalkEngine::share_by_pressure() {
  const Vector2d here = nominal_zmp(support_is_left_);
  const Vector2d way = swing_.pose() * nominal_zmp(!support_is_left_) - here;
  other_share_ = std::clamp((zmp_ - here).dot(way) / way.squaredNorm(), 0.0, 1.0);
}

void WalkEngine::give_way(double dt) {
  reference_.position +=
      std::min(1.0, gait_->absorb_position * dt) * (predicted_.position - reference_.position);
  reference_.velocity +=
      std::min(1.0, gait_->absorb_velocity * dt) * (predicted_.velocity - reference_.velocity);
}

Isometry3d WalkEngine::torso_in_support() const {
  const double heading = wrapped(swing_.pose().heading) / 2;
  Isometry3d torso;
  torso.linear() =
      (AngleAxisd(heading, Vector3d::UnitZ()) * AngleAxisd(gait_->torso_pitch, Vector3d::UnitY()))
          .toRotationMatrix();
  Vector3d hips = 0.5 * (legs_.hip(Leg::kLeft) + legs_.hip(Leg::kRight));
  torso.translation() << reference_.position - (torso.linear() * mass_centre_in_torso_).head<2>(),
      gait_->hip_height - (torso.linear() * hips).z();
  if (stage_ != Stage::kLowering) return torso;
  Isometry3d result;
  result.translation() = (1 - share_) * start_torso_.translation() + share_ * torso.translation();
  result.linear() = Eigen::Quaterniond(start_torso_.linear())
                        .slerp(share_, Eigen::Quaterniond(torso.linear()))
                        .toRotationMatrix();
  return result;
}

Isometry3d WalkEngine::swing_in_support() const {
  Pose2 pose = swing_.pose();
  double height = swing_.height();
  if (is_kick_step_ && stage_ == Stage::kStepping) {
    // Out and back within the step; at rest at both ends.
    const double out = std::sin(M_PI * std::clamp(time_ / duration_, 0.0, 1.0));
    const Vector2d reach(gait_->kick_reach + kick_offset_.x(), kick_offset_.y());
    pose.position += pose.rotate(out * out * reach);
    height += gait_->kick_lift * out * out;
  }
  const double toe_up = gait_->swing_pitch * swing_.forward_speed();
  return in_space(pose, height) * AngleAxisd(-toe_up, Vector3d::UnitY());
}

std::vector<double> WalkEngine::pose_joints() {
  const Isometry3d torso = torso_in_support();
  wished_pitch_ = std::asin(std::clamp(-torso.linear()(2, 0), -1.0, 1.0));
  const Isometry3d to_torso = torso.inverse();
  const Isometry3d support = to_torso * in_space({}, support_height_);
  const Isometry3d swing = to_torso * swing_in_support();
  const LegsSolution solution =
      legs_.solve_both(support_is_left_ ? support : swing, support_is_left_ ? swing : support);
  std::vector<double> position = wished_position_;
  legs_.write(Leg::kLeft, solution.left, position);
  legs_.write(Leg::kRight, solution.right, position);
  const double stride = swing_.pose().position.x() * side();  // right foot's lead on the left one
  for (const ArmJoint& joint : arms_) {
    const double goal = joint.angle + joint.swing * stride;
    const double start = start_position_[joint.motor];
    position[joint.motor] = stage_ == Stage::kLowering ? start + share_ * (goal - start) : goal;
  }
  return position;
}

void WalkEngine::follow_reference(double dt, JointTargets& targets) {
  const std::vector<double> position = pose_joints();
  for (size_t i = 0; i < position.size(); ++i) {
    wished_velocity_[i] = (position[i] - wished_position_[i]) / dt;
  }
  wished_position_ = position;
  reference_kinematics_.update(position);
  const double share = gait_->mass_centre_time > dt ? dt / gait_->mass_centre_time : 1.0;
  mass_centre_in_torso_ += share * (reference_kinematics_.center_of_mass() - mass_centre_in_torso_);

  const Isometry3d torso = torso_in_support();
  const Vector3d up = torso.linear().transpose() * Vector3d::UnitZ();
  const std::vector<double> torque =
      feedforward_.calc_torques(reference_kinematics_, up, plan_loads(torso));
  std::vector<double> balance(position.size(), 0.0);
  add_balance(balance);
  const bool is_raising = stage_ == Stage::kRaising || stage_ == Stage::kDone;
  // On the way up the rates are damped to the end.
  const double balance_share = is_raising ? 1 : share_;
  const auto write = [&](int motor) {
    const double other =
        is_raising ? end_posture_->position[motor] - position[motor] : start_offset_[motor];
    targets.position[motor] =
        position[motor] + (1 - share_) * other + balance_share * balance[motor] +
        share_ * (gait_->lead_time * wished_velocity_[motor] +
                  feedforward_.calc_offset(motor, gait_->torque_share * torque[motor],
                                           wished_velocity_[motor], gait_->damping_share));
  };
  for (size_t i = 0; i < 6; ++i) {
    write(legs_.motors(Leg::kLeft)[i]);
    if (i > 0) write(legs_.motors(Leg::kRight)[i]);
  }
  for (const ArmJoint& joint : arms_) write(joint.motor);
}

std::array<FootLoad, 2> WalkEngine::plan_loads(const Isometry3d& torso) const {
  const Vector2d there = swing_.pose() * nominal_zmp(!support_is_left_);
  const Vector2d error = predicted_.divergent(omega_) - reference_.divergent(omega_);
  // While both feet carry, the zero moment point lies between them and each is loaded in its
  // middle.
  const bool both = stage_ != Stage::kStepping;
  const Vector2d middle = nominal_zmp(support_is_left_);
  Vector2d here = both ? middle : zmp_;
  const double reach = gait_->zmp_reach_sideways;
  here =
      clamp_to(here + gait_->dcm_gain * error, middle - Vector2d(gait_->zmp_reach_backward, reach),
               middle + Vector2d(gait_->zmp_reach_forward, reach));
  const double mass = model_->total_mass();
  Vector3d force(0, 0, mass * kGravity);
  force.head<2>() = mass * omega_ * omega_ * (reference_.position - zmp_);
  const Vector3d force_in_torso = torso.linear().transpose() * force;
  const Isometry3d to_torso = torso.inverse();
  const FootLoad support{(1 - other_share_) * force_in_torso,
                         to_torso * Vector3d(here.x(), here.y(), support_height_)};
  const FootLoad other{other_share_ * force_in_torso,
                       to_torso * Vector3d(there.x(), there.y(), swing_.height())};
  return support_is_left_ ? std::array<FootLoad, 2>{support, other}
                          : std::array<FootLoad, 2>{other, support};
}

void WalkEngine::add_balance(std::vector<double>& offset) const {
  const double ankle_pitch =
      gait_->gyro_ankle_pitch * rate_.y() + share_ * gait_->tilt_ankle_pitch * tilt_.y();
  const double ankle_roll =
      gait_->gyro_ankle_roll * rate_.x() + share_ * gait_->tilt_ankle_roll * tilt_.x();
  const double hip_pitch = gait_->gyro_hip_pitch * rate_.y();
  const double hip_roll = gait_->gyro_hip_roll * rate_.x();
  for (const Leg leg : {Leg::kLeft, Leg::kRight}) {
    const bool is_support = (leg == Leg::kLeft) == support_is_left_;
    const double share = is_support ? 1.0 : (stage_ == Stage::kStepping ? 0.0 : 1.0);
    const auto& motors = legs_.motors(leg);
    offset[motors[1]] += share * hip_roll;
    offset[motors[2]] += share * hip_pitch;
    offset[motors[4]] += share * ankle_pitch;
    offset[motors[5]] += share * ankle_roll;
  }
}

}  // namespace nao::motion
