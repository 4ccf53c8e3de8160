#include "tools/policy-train/policy_environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "daemons/motion/estimator/state_estimator.h"
#include "daemons/motion/push_recovery.h"
#include "kinematics/pose2.h"
#include "policy/command_ramp.h"
#include "sim/disturbance_draw.h"
#include "sim/lying_start.h"

namespace nao::policy_train {
namespace {

// Tilt of a torso that has fallen, rad, if the manifest does not say, and its height, as a fraction
// of the start's. Chosen: no walk comes back from there.
constexpr double kFallenTilt = 0.6;
constexpr double kFallenHeight = 0.6;
// Time for which a lying robot comes to rest, s. Chosen.
constexpr double kLyingTime = 1;
// Share of the get-ups that begin in the air, tilted between upright and lying, with the joints at
// most this far from the ready posture, rad. Chosen: what never stands does not learn its worth.
constexpr double kTiltedShare = 0.5;
constexpr double kTiltedSpread = 1.2;
// Share of the commanded velocities that are 0, and of those with a single component. Chosen: a
// phone's sticks give such ones mostly.
constexpr double kRestShare = 0.2;
constexpr double kSingleShare = 0.3;
// Share of the commands straight ahead at the upper end of the range, from this fraction of it on,
// and share of the next commands that are then 0. Chosen: a stop from full speed is hardest.
constexpr double kFastShare = 0.35;
constexpr double kFast = 0.7;
constexpr double kFastRestShare = 0.5;
// Share of the commands 0 at which a robot that is pushed steps in place. Chosen.
constexpr double kInPlaceShare = 0.3;
// Time constant of the mean error of the velocity, s. Chosen: most of a gait cycle.
constexpr double kMeanTime = 0.5;
// Share of the episodes that begin with a push, and the greatest time from it until the policy
// moves the robot, s. Chosen: nao-motion lets a policy catch a robot 20 to 60 ms after a push.
constexpr double kPushedShare = 0.4;
constexpr double kCatchTime = 0.08;

sim::WorldOptions world_options(const EnvironmentOptions& options, uint64_t seed) {
  sim::WorldOptions result;
  result.engine = options.engine;
  result.seed = seed;
  draw_world(*options.disturbances, seed, result);
  return result;
}

}  // namespace

PolicyEnvironment::PolicyEnvironment(const EnvironmentOptions& options, const PushSchedule& pushes,
                                     uint64_t seed)
    : options_(options),
      random_(seed),
      pushes_(pushes),
      assist_(options.assist),
      world_(std::make_unique<sim::World>(options.scene, world_options(options, seed))),
      builder_(*options.manifest),
      action_(options.manifest->joints.size()),
      limiter_(*options.model),
      kinematics_(*options.model) {
  sim::RobotOptions robot;
  draw_robot(*options.disturbances, seed, 0, *options.model, world_->options(), robot);
  world_->add_robot(options.model, robot);
  for (int i = 0; i < sim::kNumSharedDraws; ++i) random_.next();
  const PolicyManifest& manifest = *options.manifest;
  const double period = world_->options().period();
  ticks_per_step_ = std::max(1, static_cast<int>(std::lround(manifest.period / period)));
  max_steps_ = static_cast<int>(std::lround(options.episode_time / manifest.period));
  const int num_motors = options.model->num_motors();
  targets_.position.resize(num_motors);
  targets_.stiffness = Eigen::VectorXd::Ones(num_motors);
  targets_.kp = Eigen::VectorXd::Map(manifest.kp.data(), static_cast<long>(manifest.kp.size()));
  targets_.kd = Eigen::VectorXd::Map(manifest.kd.data(), static_cast<long>(manifest.kd.size()));
  input_.joint_position.resize(static_cast<size_t>(num_motors));
  input_.joint_velocity = input_.joint_position;
  // The start of every episode of a walk, and what height and stance are compared with.
  std::fill(action_.begin(), action_.end(), 0.0F);
  set_targets();
  place(false);
  sample(start_.emplace());
}

void PolicyEnvironment::reset(const StepOutput& output) {
  world_->reset();
  std::fill(action_.begin(), action_.end(), 0.0F);
  set_targets();
  const PolicyManifest& manifest = *options_.manifest;
  // Only what has a phase can be push recovery.
  const bool is_pushed = options_.push > 0 && !is_get_up() && manifest.phase_frequency > 0 &&
                         random_.uniform() < kPushedShare;
  if (is_get_up() && random_.uniform() < kTiltedShare) {
    place_tilted();
  } else if (is_get_up()) {
    lay_down();
  } else {
    place(is_pushed);
  }
  builder_.reset();
  // The first episodes of robots that never fall end at different times.
  num_steps_ =
      is_get_up() && is_first_episode_ ? static_cast<int>(random_.uniform(0, max_steps_)) : 0;
  is_first_episode_ = false;
  pushes_.begin_episode();
  recovery_end_ = 0;
  cycles_since_outward_ = 0;
  input_.command = options_.command.value_or(Eigen::Vector3d::Zero());
  if (is_pushed) {
    push();
    hold(random_.uniform(0, kCatchTime));
  }
  is_resting_ = options_.rest_share > 0 && random_.uniform() < options_.rest_share;
  draw_goal();
  sample(before_);
  before_.velocity_error.setZero();
  if (is_pushed || manifest.recovery_margin) find_state();
  if (is_pushed) begin_recovery();
  observe(output);
}

void PolicyEnvironment::begin_recovery() {
  const PolicyManifest& manifest = *options_.manifest;
  const double steps_per_cycle = 1 / (manifest.phase_frequency * manifest.period);
  recovery_end_ = num_steps_ + static_cast<int>(std::lround(kRecoveryCycles * steps_per_cycle));
  builder_.restart_phase(motion::recovery_lead(state_));
  if (!options_.command) input_.command = kStepInPlace;
}

void PolicyEnvironment::answer_push() {
  const PolicyManifest& manifest = *options_.manifest;
  if (!manifest.recovery_margin) return;
  find_state();
  if (input_.command.isZero(0) && motion::is_pushed_at_rest(state_)) begin_recovery();
  cycles_since_outward_ += manifest.period * manifest.phase_frequency;
  if (cycles_since_outward_ <= motion::kOutwardCycles) return;
  if (const auto lead = motion::find_outward_lead(state_, motion::kOutwardMargin)) {
    builder_.restart_phase(*lead);
    cycles_since_outward_ = 0;
  }
}

void PolicyEnvironment::find_state() {
  const Eigen::Vector3d last = state_.center_of_mass_in_odometry;
  kinematics_.update({before_.position.begin(), before_.position.end()});
  state_.torso_in_odometry = before_.torso;
  state_.center_of_mass_in_odometry = before_.torso * kinematics_.center_of_mass();
  state_.center_of_mass_velocity_in_odometry =
      num_steps_ > 0
          ? Eigen::Vector3d((state_.center_of_mass_in_odometry - last) / options_.manifest->period)
          : Eigen::Vector3d(before_.torso.linear() * before_.linear_velocity);
  const double weight = kGravity * options_.model->total_mass();
  const double least = options_.model->references().contact_forces.contact / weight;
  state_.left_foot_carries = before_.load[0] > least;
  state_.right_foot_carries = before_.load[1] > least;
  state_.left_sole_in_odometry = before_.soles[0];
  state_.right_sole_in_odometry = before_.soles[1];
  state_.support_polygon_in_odometry = motion::calc_support_polygon(*options_.model, state_);
}

void PolicyEnvironment::place(bool is_ready) {
  Posture posture = options_.model->ready_posture();
  if (!is_ready) posture.position = options_.manifest->default_position;
  for (const PolicyJoint& joint : options_.manifest->joints) {
    double& angle = posture.position[static_cast<size_t>(joint.motor)];
    const Joint& limits = options_.model->motor_joint(joint.motor);
    const double drawn = angle + (start_ ? options_.start_spread * random_.uniform(-1, 1) : 0);
    angle = std::clamp(drawn, limits.lower, std::max(limits.lower, limits.upper));
  }
  world_->place_robot(0, &posture, Eigen::Vector3d::Zero());
  sent_ = posture.position;
}

void PolicyEnvironment::hold(double duration) {
  sim::MotorTargets held = targets_;
  held.position = Eigen::VectorXd::Map(sent_.data(), static_cast<long>(sent_.size()));
  const double period = world_->options().period();
  for (double t = 0; t < duration; t += period) {
    world_->set_targets(0, held);
    world_->step_tick();
  }
}

void PolicyEnvironment::step_tick() {
  if (is_get_up() && assist_.share() > 0) {
    const double impulse = options_.model->total_mass() * kGravity * world_->options().period();
    world_->push(0, 0, {0, 0, assist_.share() * impulse});
  }
  position_.assign(targets_.position.begin(), targets_.position.end());
  limiter_.limit(sent_, world_->options().period(), position_);
  std::swap(sent_, position_);
  sim::MotorTargets limited = targets_;
  limited.position = Eigen::VectorXd::Map(sent_.data(), static_cast<long>(sent_.size()));
  world_->set_targets(0, limited);
  world_->step_tick();
}

void PolicyEnvironment::place_tilted() {
  const Posture posture =
      sim::draw_posture(*options_.model, random_.uniform(0, kTiltedSpread),
                        [this](double low, double high) { return random_.uniform(low, high); });
  const double side = random_.uniform(-M_PI, M_PI);
  const Eigen::Vector3d axis(std::cos(side), std::sin(side), 0);
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(random_.uniform(0, M_PI / 2), axis));
  world_->place_robot(0, &posture, Eigen::Vector3d::Zero(), &tilted);
  sent_ = posture.position;
}

void PolicyEnvironment::lay_down() {
  const Posture posture =
      sim::lay_down(*world_, 0, random_.uniform(-M_PI, M_PI),
                    [this](double low, double high) { return random_.uniform(low, high); });
  sent_ = posture.position;
  hold(kLyingTime);
}

void PolicyEnvironment::step(const float* action, const StepOutput& output) {
  const PolicyManifest& manifest = *options_.manifest;
  const auto clip = static_cast<float>(manifest.action_clip);
  for (size_t i = 0; i < action_.size(); ++i) {
    action_[i] = std::isfinite(action[i]) ? std::clamp(action[i], -clip, clip) : 0.0F;
  }
  set_targets();
  if (options_.push > 0 && pushes_.is_due(manifest.period, random_)) push();
  for (int i = 0; i < ticks_per_step_; ++i) step_tick();
  ++num_steps_;
  sample(after_);
  Eigen::Vector3d error = velocity_in_heading(after_) - input_.command;
  error.z() = (after_.torso.linear() * after_.angular_velocity).z() - input_.command.z();
  after_.velocity_error =
      before_.velocity_error + (error - before_.velocity_error) * manifest.period / kMeanTime;
  after_.assist = assist_.share();
  const double up = after_.torso.linear()(2, 2);
  const bool fallen = !is_get_up() && (up < std::cos(manifest.fall_tilt.value_or(kFallenTilt)) ||
                                       after_.torso.translation().z() <
                                           kFallenHeight * start_->torso.translation().z());
  calc_reward_terms(*options_.model, manifest, *start_, before_, after_, input_.command,
                    builder_.phase(), fallen, output.reward_terms);
  pushes_.judge(time(), fallen);
  *output.terminated = fallen ? 1 : 0;
  *output.truncated = !fallen && num_steps_ >= max_steps_ ? 1 : 0;
  if (is_get_up() && *output.truncated != 0) {
    assist_.learn(output.reward_terms[static_cast<size_t>(RewardTerm::kStanding)] > 0);
  }
  std::swap(before_, after_);
  if (*output.terminated != 0 || *output.truncated != 0) {
    observe(output);
    std::copy_n(output.observation, manifest.num_observations(), output.final_observation);
    reset(output);
    return;
  }
  if (random_.uniform() < manifest.period / options_.command_time) draw_goal();
  answer_push();
  if (num_steps_ >= recovery_end_) {
    input_.command = ramp_command(input_.command, goal_, manifest.period);
  }
  observe(output);
}

void PolicyEnvironment::set_targets() {
  const PolicyManifest& manifest = *options_.manifest;
  targets_.position = Eigen::VectorXd::Map(manifest.default_position.data(),
                                           static_cast<long>(manifest.default_position.size()));
  for (size_t i = 0; i < action_.size(); ++i) {
    const PolicyJoint& joint = manifest.joints[i];
    targets_.position[joint.motor] =
        joint.default_angle + joint.scale * static_cast<double>(action_[i]);
  }
}

void PolicyEnvironment::draw_goal() {
  const PolicyManifest& manifest = *options_.manifest;
  if (options_.command || is_resting_ || manifest.kind != PolicyManifest::Kind::kWalk) {
    goal_ = options_.command.value_or(Eigen::Vector3d::Zero());
    return;
  }
  const Eigen::Vector3d goal_before = goal_;
  goal_ = {random_.uniform(manifest.vx.lower, manifest.vx.upper),
           random_.uniform(manifest.vy.lower, manifest.vy.upper),
           random_.uniform(manifest.wz.lower, manifest.wz.upper)};
  const double kind = random_.uniform();
  const auto single = static_cast<long>(random_.uniform(0, 3));
  const double rest_share =
      goal_before.x() > kFast * manifest.vx.upper ? kFastRestShare : kRestShare;
  if (kind < rest_share) {
    goal_.setZero();
    if (options_.push > 0 && random_.uniform() < kInPlaceShare) goal_ = kStepInPlace;
  } else if (kind > 1 - kFastShare) {
    goal_ = {random_.uniform(kFast, 1) * manifest.vx.upper, 0, 0};
  } else if (kind < kRestShare + kSingleShare) {
    for (long i = 0; i < 3; ++i) {
      if (i != single) goal_[i] = 0;
    }
  }
}

void PolicyEnvironment::push() {
  const bool is_stepping =
      options_.manifest->phase_frequency > 0 && !is_at_rest(*options_.manifest, input_.command);
  const Eigen::Vector2d impulse =
      pushes_.push(is_stepping ? std::optional(builder_.phase()) : std::nullopt, time(), random_);
  const Eigen::Rotation2Dd heading(heading_of(world_->robot(0).link_pose(0).linear()));
  const Eigen::Vector2d in_world = heading * impulse * options_.model->total_mass();
  world_->push(0, 0, {in_world.x(), in_world.y(), 0});
}

void PolicyEnvironment::sample(MotionSample& sample) const {
  const sim::SimRobot& robot = world_->robot(0);
  const RobotModel& model = *options_.model;
  sample.torso = robot.link_pose(0);
  const Eigen::Matrix3d torso_from_world = sample.torso.linear().transpose();
  sample.angular_velocity = torso_from_world * robot.state().velocity.head<3>();
  sample.linear_velocity = torso_from_world * robot.state().velocity.segment<3>(3);
  const std::array<int, 2> soles = {model.left_sole(), model.right_sole()};
  for (size_t foot = 0; foot < 2; ++foot) sample.soles[foot] = robot.link_pose(soles[foot]);
  sample.load.fill(0);
  for (const sim::Contact& contact : world_->contacts()) {
    for (size_t foot = 0; foot < 2; ++foot) {
      if (contact.a.kind != sim::Surface::Kind::kRobot ||
          contact.b.kind != sim::Surface::Kind::kFloor ||
          model.find_body(contact.a.link) != model.find_body(soles[foot])) {
        continue;
      }
      sample.load[foot] += contact.force_on_a.z() / (kGravity * model.total_mass());
    }
  }
  sample.position = robot.motor_position();
  sample.velocity = robot.motor_velocity();
  sample.torque = robot.motor_torque();
  sample.target = targets_.position;
}

void PolicyEnvironment::observe(const StepOutput& output) {
  const sim::SensorReadings& readings = world_->sensors(0);
  const auto count = static_cast<long>(input_.joint_position.size());
  input_.angular_velocity = readings.gyroscope;
  input_.projected_gravity = -(readings.orientation.conjugate() * Eigen::Vector3d::UnitZ());
  // nao-motion estimates it; the truth stands for that here.
  input_.linear_velocity = before_.linear_velocity;
  Eigen::VectorXd::Map(input_.joint_position.data(), count) = readings.position;
  Eigen::VectorXd::Map(input_.joint_velocity.data(), count) = readings.velocity;
  const std::vector<float>& observation = builder_.build(input_, action_);
  std::copy(observation.begin(), observation.end(), output.observation);
  const double height = before_.torso.translation().z() / start_->torso.translation().z() - 1;
  const std::array<double, kNumPrivileged> privileged = {before_.linear_velocity.x(),
                                                         before_.linear_velocity.y(),
                                                         before_.linear_velocity.z(),
                                                         before_.angular_velocity.x(),
                                                         before_.angular_velocity.y(),
                                                         before_.angular_velocity.z(),
                                                         height,
                                                         before_.load[0],
                                                         before_.load[1]};
  std::copy(privileged.begin(), privileged.end(), output.privileged);
}

}  // namespace nao::policy_train
