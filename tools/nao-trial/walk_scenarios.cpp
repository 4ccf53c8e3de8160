#include "tools/nao-trial/scenarios.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "common/constants.h"
#include "common/output_file.h"
#include "kinematics/pose2.h"
#include "tools/nao-trial/fall_warning.h"

namespace nao::trial {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Time before the first command in which the state estimate converges, s.
constexpr double kStand = 1;
// Time from the command until the gait has reached its velocity, s.
constexpr double kSpeedUp = 2.5;
constexpr double kFallenHeight = 0.625;  // of the standing height, of the torso
constexpr double kFallenTilt = 1.0;      // rad
// Fraction of the commanded velocity below which a robot has not walked.
constexpr double kLeastFraction = 0.5;

bool has_fallen(const ClosedLoop& trial) {
  return trial.torso_height() < kFallenHeight * trial.model().references().heights.standing ||
         trial.torso_tilt() > kFallenTilt;
}

Pose2 true_pose(const ClosedLoop& trial) {
  return Pose2::from(trial.torso_in_world());
}

Pose2 estimated_pose(const ClosedLoop& trial) {
  return Pose2::from(trial.estimate().torso_in_odometry);
}

/** Difference between the displacement by odometry and the true one, m. */
class OdometryCheck {
 public:
  explicit OdometryCheck(const ClosedLoop& trial)
      : truth_(true_pose(trial)), estimate_(estimated_pose(trial)) {}
  double error(const ClosedLoop& trial) const {
    return (truth_.inverse() * true_pose(trial).position -
            estimate_.inverse() * estimated_pose(trial).position)
        .norm();
  }

 private:
  Pose2 truth_;
  Pose2 estimate_;
};

/** Runs until a time has passed or the robot fell. @return false if it fell. */
bool run_upright(ClosedLoop& trial, double duration) {
  trial.run_until([&] { return has_fallen(trial); }, duration);
  return !has_fallen(trial);
}

/** Mean velocity in the robot's frame: for each second, the constant body twist that moves the
 * robot from its pose at the beginning to its pose at the end. */
class VelocityMean {
 public:
  explicit VelocityMean(const ClosedLoop& trial)
      : ticks_per_second_(static_cast<int>(std::lround(1 / trial.period()))),
        period_(trial.period()),
        last_(true_pose(trial)) {}
  void add(const ClosedLoop& trial) {
    // Over a second: shorter times would measure the sway of each step.
    if (++ticks_ < ticks_per_second_) return;
    ticks_ = 0;
    const Pose2 now = true_pose(trial);
    const double turn = wrapped(now.heading - last_.heading);
    // Inverse of the exponential map of a planar twist: R. Murray, Z. Li, S. Sastry, "A
    // mathematical introduction to robotic manipulation", 1994, eq. 2.36, in the plane.
    const double half = turn / 2;
    const double stretch = std::abs(half) > 1e-6 ? half / std::tan(half) : 1;
    Eigen::Matrix2d inverse;
    inverse << stretch, half, -half, stretch;
    const Vector2d way = inverse * (last_.inverse() * now.position);
    sum_ += Vector3d(way.x(), way.y(), turn);
    time_ += ticks_per_second_ * period_;
    last_ = now;
  }
  Vector3d mean() const { return sum_ / std::max(time_, period_); }

 private:
  int ticks_per_second_;
  double period_;
  Pose2 last_;
  Vector3d sum_ = Vector3d::Zero();
  double time_ = 0;
  int ticks_ = 0;
};

/** True and estimated path of a robot, each relative to its start. */
class Trace {
 public:
  explicit Trace(const ClosedLoop& trial)
      : truth_(true_pose(trial)), estimate_(estimated_pose(trial)), start_(trial.time()) {}
  void add(const ClosedLoop& trial) {
    // Every tenth tick is enough for a plot.
    if (ticks_++ % 10 != 0) return;
    const Vector2d truth = truth_.inverse() * true_pose(trial).position;
    const Vector2d estimate = estimate_.inverse() * estimated_pose(trial).position;
    text_ << trial.time() - start_ << ',' << truth.x() << ',' << truth.y() << ',' << estimate.x()
          << ',' << estimate.y() << '\n';
  }
  /** @throws Error */
  void write(const std::string& path) const {
    replace_file(path, "time,true_x,true_y,odometry_x,odometry_y\n" + text_.str());
  }

 private:
  Pose2 truth_;
  Pose2 estimate_;
  double start_;
  int ticks_ = 0;
  std::ostringstream text_;
};

/** Detects when a stopping robot stands still: the time after which its torso moves slower than the
 * limits below. */
class StandstillDetector {
 public:
  explicit StandstillDetector(const ClosedLoop& trial)
      : start_(trial.time()), last_(trial.torso_in_world()), place_(true_pose(trial)) {}
  void look(const ClosedLoop& trial) {
    const Eigen::Isometry3d now = trial.torso_in_world();
    const double speed = (now.translation() - last_.translation()).norm() / trial.period();
    // Rotation between two ticks: over the period it is the angular velocity.
    const double turning = Eigen::AngleAxisd(last_.linear().transpose() * now.linear()).angle();
    last_ = now;
    if (speed > kStillSpeed || turning / trial.period() > kStillTurning)
      still_since_ = trial.time();
  }
  /** Time from the construction until the robot stood still, s. */
  double duration() const { return std::max(0.0, still_since_ - start_); }
  /** Distance from the position at the construction, m. */
  double way(const ClosedLoop& trial) const {
    return (true_pose(trial).position - place_.position).norm();
  }

 private:
  // Limits of a standing torso, m/s and rad/s. Chosen: visibly at rest.
  static constexpr double kStillSpeed = 0.03;
  static constexpr double kStillTurning = 0.2;
  double start_;
  double still_since_ = 0;
  Eigen::Isometry3d last_;
  Pose2 place_;
};

RunResult failed(std::string failure) {
  RunResult result;
  result.failure = std::move(failure);
  return result;
}

RunResult fallen(double time) {
  RunResult result = failed("fell after " + std::to_string(std::lround(time)) + " s");
  result.metrics = {{"upright_s", time}};
  return result;
}

/** Why a walk has ended before it was told to; nothing while it goes on. */
std::optional<std::string> find_early_end(const ClosedLoop& trial, int64_t walk) {
  for (const CommandResult& result : trial.results()) {
    if (result.id != walk || result.status == ResultStatus::kAccepted) continue;
    return "did not walk: " + to_sentence(result.reason);
  }
  return std::nullopt;
}

std::vector<RunResult> run_walk(const ScenarioOptions& options, uint64_t seed) {
  const double duration = options.duration > 0 ? options.duration : 10;
  ClosedLoop trial(options.trial, seed);
  trial.run(kStand);
  const Pose2 start_pose = true_pose(trial);
  const int64_t walk = trial.hold_walk(options.velocity);
  const double start = trial.time();
  if (!run_upright(trial, kSpeedUp)) return {fallen(trial.time() - start)};
  VelocityMean velocity(trial);
  // Odometry and truth are compared from the same moment on.
  const OdometryCheck odometry(trial);
  const Pose2 way_start = true_pose(trial);
  Trace trace(trial);
  trial.on_tick([&] {
    velocity.add(trial);
    trace.add(trial);
  });
  if (!run_upright(trial, duration)) return {fallen(trial.time() - start)};
  trial.on_tick({});
  if (const auto early_end = find_early_end(trial, walk)) return {failed(*early_end)};
  if (!options.trace_file.empty()) trace.write(options.trace_file);
  const Vector3d mean = velocity.mean();
  const double odometry_error = odometry.error(trial);
  // This is before the stop, which is measured separately.
  const Pose2 way_end = true_pose(trial);

  StandstillDetector standstill(trial);
  trial.on_tick([&] { standstill.look(trial); });
  trial.release_walk();
  const auto end = trial.await_end(walk, 10);
  trial.run(0.5);
  if (has_fallen(trial)) return {failed("fell while stopping")};
  if (!end) return {failed("did not stop: its feet never stood side by side")};
  if (end->status != ResultStatus::kDone) {
    return {failed("did not stop: " + to_sentence(end->reason))};
  }
  // Error of the executed velocity; the weight of 1 rad equals 0.15 m.
  const Vector3d scale(1, 1, 0.15);
  const Vector3d missed = (mean - options.velocity).cwiseProduct(scale);
  const double commanded = options.velocity.cwiseProduct(scale).norm();
  const double distance = mean.head<2>().norm() * duration;
  // Velocity along the commanded one, as a fraction of it.
  const double fraction = mean.cwiseProduct(scale).dot(options.velocity.cwiseProduct(scale)) /
                          std::max(1e-12, commanded * commanded);
  RunResult result;
  result.is_success = commanded == 0 || fraction >= kLeastFraction;
  if (!result.is_success) {
    result.failure =
        "too slow: " + std::to_string(std::lround(100 * fraction)) + " % of the commanded velocity";
  }
  result.metrics = {{"speed_mps", mean.head<2>().norm()},
                    {"turning_radps", mean.z()},
                    {"tracking_error", commanded > 0 ? missed.norm() / commanded : missed.norm()},
                    {"stopping_s", standstill.duration()},
                    {"stopping_mm", 1e3 * standstill.way(trial)}};
  const bool is_straight = options.velocity.z() == 0 && distance > 0;
  if (is_straight) {
    // Lateral deviation from the commanded line, extrapolated to 5 m.
    const Vector2d line =
        (Rotation2Dd(start_pose.heading) * options.velocity.head<2>()).normalized();
    const Vector2d went = way_end.position - way_start.position;
    const double off = std::abs(line.x() * went.y() - line.y() * went.x());
    result.metrics.emplace_back("drift_5m_mm", 1e3 * off * 5 / went.norm());
  }
  if (distance > 0.5) result.metrics.emplace_back("odometry_error", odometry_error / distance);
  return {result};
}

std::vector<RunResult> run_sprint(const ScenarioOptions& options, uint64_t seed) {
  const double distance = options.distance > 0 ? options.distance : 10;
  ClosedLoop trial(options.trial, seed);
  trial.run(kStand);
  const Pose2 start = true_pose(trial);
  const OdometryCheck odometry(trial);
  const double start_time = trial.time();
  trial.hold_walk({trial.model().walk_limits().forward, 0, 0});
  double way = 0;
  // Three times the expected duration of the walk, plus the start.
  const double timeout = 20 + 3 * distance / trial.model().walk_limits().forward;
  trial.run_until(
      [&] {
        way = (true_pose(trial).position - start.position).norm();
        return has_fallen(trial) || way >= distance;
      },
      timeout);
  if (has_fallen(trial)) return {fallen(trial.time() - start_time)};
  RunResult result;
  result.is_success = way >= distance;
  if (!result.is_success) result.failure = "too slow";
  result.metrics = {{"speed_mps", way / (trial.time() - start_time)},
                    {"drift_mm", 1e3 * std::abs((start.inverse() * true_pose(trial).position).y())},
                    {"odometry_error", odometry.error(trial) / way}};
  return {result};
}

std::vector<RunResult> run_joystick(const ScenarioOptions& options, uint64_t seed) {
  const double duration = options.duration > 0 ? options.duration : 600;
  ClosedLoop trial(options.trial, seed);
  const WalkLimits limits = trial.model().walk_limits();
  trial.run(kStand);
  const double start = trial.time();
  // Random stick positions, each held for a random time, until the duration has passed.
  while (trial.time() - start < duration) {
    const double kind = trial.random(0, 1);
    const Vector3d stick(trial.random(-1, 1), trial.random(-1, 1), trial.random(-1, 1));
    Vector3d velocity(stick.x() * (stick.x() > 0 ? limits.forward : limits.backward),
                      stick.y() * limits.sideways, stick.z() * limits.turning);
    if (kind < 0.15) velocity = {limits.forward, 0, 0};  // pressed to the stop
    if (kind > 0.85) {
      trial.release_walk();
    } else {
      trial.hold_walk(velocity);
    }
    if (!run_upright(trial, trial.random(0.2, 4))) break;
  }
  RunResult result;
  result.is_success = !has_fallen(trial);
  if (!result.is_success) result = fallen(trial.time() - start);
  result.metrics = {{"falls", has_fallen(trial) ? 1 : 0}, {"duration_s", trial.time() - start}};
  return {result};
}

std::vector<RunResult> run_move_to(const ScenarioOptions& options, uint64_t seed) {
  ClosedLoop trial(options.trial, seed);
  trial.run(kStand);
  const double distance = trial.random(0.1, 2);
  const double direction = trial.random(-M_PI, M_PI);
  const double turn = trial.random(-M_PI, M_PI);
  // In the frame of the robot at the start, as the command is.
  const Vector2d goal = distance * Vector2d(std::cos(direction), std::sin(direction));
  const Pose2 start = true_pose(trial);
  const Pose2 estimated_start = estimated_pose(trial);
  const double start_time = trial.time();
  const int64_t id = trial.send({"", 0, MoveToCommand{goal.x(), goal.y(), turn}});
  std::optional<CommandResult> end;
  size_t next = 0;
  trial.run_until(
      [&] {
        for (; next < trial.results().size(); ++next) {
          const CommandResult& found = trial.results()[next];
          if (found.id == id && found.status != ResultStatus::kAccepted) end = found;
        }
        return end || has_fallen(trial);
      },
      120);
  if (has_fallen(trial)) return {fallen(trial.time() - start_time)};
  const double time = trial.time() - start_time;
  trial.run(0.5);
  const auto miss = [&](const Pose2& from, const Pose2& to) {
    return (from.inverse() * to.position - goal).norm();
  };
  const auto turn_miss = [&](const Pose2& from, const Pose2& to) {
    return std::abs(wrapped(to.heading - from.heading - turn)) / kDegree;
  };
  const double by_odometry = miss(estimated_start, estimated_pose(trial));
  const double turned = turn_miss(estimated_start, estimated_pose(trial));
  RunResult result;
  // Tolerance: 3 cm and 3 degrees for each meter of the path, at least those of 1 m.
  const double scale = std::max(1.0, distance);
  result.is_success =
      end && end->status == ResultStatus::kDone && by_odometry < 0.03 * scale && turned < 3 * scale;
  if (!result.is_success)
    result.failure = end ? "missed; " + to_sentence(end->reason) : "did not end";
  result.metrics = {{"odometry_miss_mm", 1e3 * by_odometry},
                    {"odometry_miss_deg", turned},
                    {"true_miss_mm", 1e3 * miss(start, true_pose(trial))},
                    {"true_miss_deg", turn_miss(start, true_pose(trial))},
                    {"time_s", time}};
  return {result};
}

}  // namespace

Scenario walk_scenario() {
  return {"walk",
          "Walk at --vx --vy --wz for --duration (10 s), then stand",
          {{"speed_mps", "m/s"},
           {"turning_radps", "rad/s"},
           {"tracking_error", "1"},
           {"odometry_error", "1"},
           {"stopping_s", "s"},
           {"stopping_mm", "mm"},
           {"drift_5m_mm", "mm"},
           {"upright_s", "s"}},
          run_walk};
}

Scenario sprint_scenario() {
  return {"sprint",
          "Walk --distance (10 m) ahead at the maximum speed; fails with the torso below 0.20 m",
          {{"speed_mps", "m/s"}, {"drift_mm", "mm"}, {"odometry_error", "1"}},
          run_sprint};
}

Scenario joystick_scenario() {
  return {"joystick",
          "Walk with random joystick input for --duration (600 s)",
          {{"falls", "1"}, {"duration_s", "s"}},
          run_joystick};
}

Scenario move_to_scenario() {
  return {"move-to",
          "Move to a random pose up to 2 m away",
          {{"odometry_miss_mm", "mm"},
           {"odometry_miss_deg", "degrees"},
           {"true_miss_mm", "mm"},
           {"true_miss_deg", "degrees"},
           {"time_s", "s"}},
          run_move_to};
}

}  // namespace nao::trial
