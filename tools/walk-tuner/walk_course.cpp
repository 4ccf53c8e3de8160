#include "tools/walk-tuner/walk_course.h"

#include <algorithm>
#include <cmath>

#include "kinematics/pose2.h"

namespace nao::tool {
namespace {

using Eigen::Vector3d;

constexpr double kStandDuration = 0.5;    // s before the walk
constexpr double kSpeedUpDuration = 2;    // s until the velocity is measured
constexpr double kWalkDuration = 7;       // s at one velocity
constexpr double kJoystickDuration = 15;  // s of random velocities
constexpr double kStopDuration = 2;       // s to come to a stand
// Change of the velocity of the whole robot by a push, m/s: an impulse of 0.8 N s on 5.3 kg.
constexpr double kPushedVelocity = 0.15;
// A walk has ended in a fall below this height of the torso, m, or above this tilt, rad.
constexpr double kFallenHeight = 0.625;
constexpr double kFallenTilt = 1.0;
// Velocity errors: 1 rad/s counts as 0.15 m/s, about half the robot's width.
const Vector3d kVelocityScale(1, 1, 0.15);
// Least velocity that an error is relative to, m/s.
constexpr double kMinVelocity = 0.1;

/** A walk and the sums that its cost is made of. */
class EvaluatedWalk {
 public:
  EvaluatedWalk(const ClosedLoopOptions& options, uint64_t seed, double planned_time)
      : trial_(options, seed), planned_time_(planned_time) {
    trial_.run(kStandDuration);
    last_pose_ = Pose2::from(trial_.torso_in_world());
  }

  ClosedLoop& trial() { return trial_; }
  bool has_fallen() const { return has_fallen_; }

  /** Walks for a time. @param commanded  Velocity that the mean velocity is compared with, or null:
   * m/s, m/s, rad/s. */
  void run(double duration, const Vector3d* commanded) {
    Vector3d displacement = Vector3d::Zero();
    double time = 0;
    for (; time < duration && !has_fallen_; time += trial_.period()) {
      trial_.step();
      displacement += measure_displacement();
      add_tick();
    }
    time_ += time;
    if (commanded == nullptr || has_fallen_) return;
    const Vector3d error = (displacement / time - *commanded).cwiseProduct(kVelocityScale);
    const double scale = std::max(kMinVelocity, commanded->cwiseProduct(kVelocityScale).norm());
    velocity_error_ += error.norm() / scale;
  }

  double cost() const {
    if (has_fallen_) return 2 + 2 * std::max(0.0, 1 - time_ / planned_time_);
    return std::min(1.0, velocity_error_) +
           0.5 * std::min(1.0, std::sqrt(squared_rate_ / num_ticks_)) +
           0.2 * std::min(2.0, squared_load_ / num_ticks_);
  }

 private:
  /** Since the last tick, m, m, rad, in the torso's heading frame. */
  Vector3d measure_displacement() {
    const Pose2 pose = Pose2::from(trial_.torso_in_world());
    const Eigen::Vector2d displacement = last_pose_.inverse() * pose.position;
    const double turn = wrapped(pose.heading - last_pose_.heading);
    last_pose_ = pose;
    return {displacement.x(), displacement.y(), turn};
  }

  void add_tick() {
    const sim::SensorReadings& readings = trial_.world().sensors(0);
    squared_rate_ += readings.gyroscope.head<2>().squaredNorm();
    for (int motor = 0; motor < trial_.model().num_motors(); ++motor) {
      const double load = readings.torque[motor] / trial_.model().motor_joint(motor).max_torque;
      squared_load_ += load * load;
    }
    ++num_ticks_;
    has_fallen_ =
        trial_.torso_height() < kFallenHeight * trial_.model().references().heights.standing ||
        trial_.torso_tilt() > kFallenTilt;
  }

  ClosedLoop trial_;
  double planned_time_;
  Pose2 last_pose_;
  bool has_fallen_ = false;
  /** s. */
  double time_ = 0;
  /** Relative. */
  double velocity_error_ = 0;
  /** Sums over the ticks: rad^2/s^2; squared torque relative to the peak torque, all motors. */
  double squared_rate_ = 0;
  double squared_load_ = 0;
  int num_ticks_ = 1;
};

/** Walks at one velocity, and stops. */
void walk_straight(EvaluatedWalk& walk, const Vector3d& velocity) {
  walk.trial().hold_walk(velocity);
  walk.run(kSpeedUpDuration, nullptr);
  walk.run(kWalkDuration, &velocity);
  walk.trial().release_walk();
  walk.run(kStopDuration, nullptr);
}

/** Random velocities, held for random times. */
void walk_as_with_a_joystick(EvaluatedWalk& walk, double speed) {
  const WalkLimits& limits = walk.trial().model().walk_limits();
  for (double time = 0; time < kJoystickDuration;) {
    ClosedLoop& trial = walk.trial();
    const double x = trial.random(-1, 1);
    const Vector3d velocity(x * (x > 0 ? limits.forward : limits.backward),
                            trial.random(-1, 1) * limits.sideways,
                            trial.random(-1, 1) * limits.turning);
    trial.hold_walk(speed * velocity);
    const double duration = trial.random(0.3, 2.5);
    walk.run(duration, nullptr);
    time += duration;
  }
}

/** A push in a random direction at a random phase of the step. */
void walk_with_a_push(EvaluatedWalk& walk, double forward) {
  ClosedLoop& trial = walk.trial();
  trial.hold_walk({0.5 * forward, 0, 0});
  walk.run(trial.random(3, 4), nullptr);
  const double direction = trial.random(-M_PI, M_PI);
  const double impulse = kPushedVelocity * trial.model().total_mass();
  trial.world().push(0, 0, impulse * Vector3d(std::cos(direction), std::sin(direction), 0));
  walk.run(kWalkDuration / 2, nullptr);
}

}  // namespace

WalkResult WalkCourse::run(ClosedLoopOptions options, const motion::Gait& gait, uint64_t seed,
                           int walk) const {
  const WalkLimits& limits = options.model->walk_limits();
  // Constant velocities; sideways and turning to the left for even seeds.
  const double left = seed % 2 == 0 ? 1 : -1;
  const double forward = speed_ * limits.forward;
  const double sideways = left * speed_ * limits.sideways;
  const double turning = left * speed_ * limits.turning;
  constexpr int kNumVelocities = 6;
  const Vector3d velocities[kNumVelocities] = {
      {forward, 0, 0},  {0.6 * forward, 0, 0}, {-speed_ * limits.backward, 0, 0},
      {0, sideways, 0}, {0, 0, turning},       {0.6 * forward, 0.4 * sideways, -0.4 * turning}};
  // Two walks with a joystick, then those with a push.
  constexpr int kFirstPush = 8;

  options.motion.gait = gait;
  double planned_time = kSpeedUpDuration + kWalkDuration;
  if (walk < kNumVelocities) {
    planned_time += kStopDuration;
  } else if (walk < kFirstPush) {
    planned_time = kJoystickDuration;
  }
  EvaluatedWalk evaluated(options, seed * 100 + static_cast<uint64_t>(walk), planned_time);
  if (walk < kNumVelocities) {
    walk_straight(evaluated, velocities[walk]);
  } else if (walk < kFirstPush) {
    walk_as_with_a_joystick(evaluated, speed_);
  } else {
    walk_with_a_push(evaluated, forward);
  }
  return {evaluated.cost(), evaluated.has_fallen()};
}

}  // namespace nao::tool
