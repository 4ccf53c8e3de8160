#include "tools/walk-tuner/walk_course.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "closed_loop/closed_loop.h"

namespace nao {
namespace {

using Eigen::Vector3d;

constexpr double kTick = 0.01;
constexpr double kStand = 0.5;  // s before the walk
constexpr double kSpeedUp = 2;  // s until a velocity counts
constexpr double kWalk = 7;     // s at one velocity
constexpr double kThumb = 15;   // s of joystick
constexpr double kStop = 2;     // s to come to a stand
constexpr double kPush = 0.8;   // N s
constexpr double kFallenHeight = 0.2;
constexpr double kFallenTilt = 1.0;
// A radian weighs like so many metres: about half the robot's width.
const Vector3d kScale(1, 1, 0.15);

/** One walk, and the sums that it is judged by. */
class JudgedWalk {
 public:
  JudgedWalk(const ClosedLoopOptions& options, uint64_t seed, double planned_time)
      : trial_(options, seed), planned_time_(planned_time) {
    trial_.run(kStand);
    last_ = trial_.torso_in_world();
  }

  ClosedLoop& trial() { return trial_; }
  bool has_fallen() const { return has_fallen_; }

  /** Walks on for a while. @param wished  Velocity to be judged by, if any. */
  void run(double duration, const Vector3d* wished) {
    Vector3d way = Vector3d::Zero();
    double time = 0;
    for (; time < duration && !has_fallen_; time += kTick) {
      trial_.step();
      way += advance();
      watch();
    }
    time_ += time;
    if (wished == nullptr || has_fallen_) return;
    const Vector3d missed = (way / time - *wished).cwiseProduct(kScale);
    error_ += missed.norm() / std::max(0.1, wished->cwiseProduct(kScale).norm());
  }

  double cost() const {
    if (has_fallen_) return 2 + 2 * std::max(0.0, 1 - time_ / planned_time_);
    return std::min(1.0, error_) + 0.5 * std::min(1.0, std::sqrt(shake_ / num_ticks_)) +
           0.2 * std::min(2.0, effort_ / num_ticks_);
  }

 private:
  /** Way since the last tick, m, m, rad, in the robot's heading frame. */
  Vector3d advance() {
    const Eigen::Isometry3d now = trial_.torso_in_world();
    const auto heading = [](const Eigen::Isometry3d& pose) {
      return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
    };
    const Eigen::Vector2d way =
        Eigen::Rotation2Dd(-heading(last_)) * (now.translation() - last_.translation()).head<2>();
    const double turn = std::remainder(heading(now) - heading(last_), 2 * M_PI);
    last_ = now;
    return {way.x(), way.y(), turn};
  }

  void watch() {
    const sim::SensorReadings& readings = trial_.world().sensors(0);
    shake_ += readings.gyroscope.head<2>().squaredNorm();
    for (int motor = 0; motor < trial_.model().num_motors(); ++motor) {
      const double load = readings.torque[motor] / trial_.model().motor_joint(motor).max_torque;
      effort_ += load * load;
    }
    ++num_ticks_;
    has_fallen_ = trial_.torso_height() < kFallenHeight || trial_.torso_tilt() > kFallenTilt;
  }

  ClosedLoop trial_;
  double planned_time_;
  Eigen::Isometry3d last_;
  bool has_fallen_ = false;
  double time_ = 0;
  double error_ = 0;
  double shake_ = 0;
  double effort_ = 0;
  int num_ticks_ = 1;
};

}  // namespace

CourseResult WalkCourse::run(const motion::Gait& gait, uint64_t seed) const {
  ClosedLoopOptions options;
  options.model = model_;
  options.scene = scene_;
  options.motion.gait = gait;
  options.late_share = late_share_;
  const WalkLimits& limits = model_->walk_limits();
  CourseResult result;
  const auto next_seed = [&] { return seed * 100 + static_cast<uint64_t>(result.num_walks); };
  const auto judge = [&](const JudgedWalk& walk) {
    result.cost += walk.cost();
    result.num_falls += walk.has_fallen() ? 1 : 0;
    ++result.num_walks;
  };

  const double left = seed % 2 == 0 ? 1 : -1;
  const double forward = speed_ * limits.forward;
  const double sideways = left * speed_ * limits.sideways;
  const double turning = left * speed_ * limits.turning;
  const std::vector<Vector3d> wishes = {
      {forward, 0, 0},  {0.6 * forward, 0, 0}, {-speed_ * limits.backward, 0, 0},
      {0, sideways, 0}, {0, 0, turning},       {0.6 * forward, 0.4 * sideways, -0.4 * turning}};
  for (const Vector3d& wish : wishes) {
    JudgedWalk walk(options, next_seed(), kSpeedUp + kWalk + kStop);
    walk.trial().hold_walk(wish);
    walk.run(kSpeedUp, nullptr);
    walk.run(kWalk, &wish);
    walk.trial().release_walk();
    walk.run(kStop, nullptr);
    judge(walk);
  }
  for (int i = 0; i < 2; ++i) {
    JudgedWalk walk(options, next_seed(), kThumb);
    for (double time = 0; time < kThumb;) {
      ClosedLoop& trial = walk.trial();
      const double x = trial.random(-1, 1);
      const Vector3d wish(x * (x > 0 ? limits.forward : limits.backward),
                          trial.random(-1, 1) * limits.sideways,
                          trial.random(-1, 1) * limits.turning);
      trial.hold_walk(speed_ * wish);
      const double duration = trial.random(0.3, 2.5);
      walk.run(duration, nullptr);
      time += duration;
    }
    judge(walk);
  }
  for (int i = 0; i < 2; ++i) {
    JudgedWalk walk(options, next_seed(), kSpeedUp + kWalk);
    ClosedLoop& trial = walk.trial();
    const Vector3d wish(0.5 * forward, 0, 0);
    trial.hold_walk(wish);
    walk.run(trial.random(3, 4), nullptr);
    const double direction = trial.random(-M_PI, M_PI);
    trial.world().push(0, 0, kPush * Vector3d(std::cos(direction), std::sin(direction), 0));
    walk.run(kWalk / 2, nullptr);
    judge(walk);
  }
  result.cost /= result.num_walks;
  return result;
}

}  // namespace nao
