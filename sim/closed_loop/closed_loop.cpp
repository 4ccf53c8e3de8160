#include "sim/closed_loop/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.h"
#include "sim/disturbance_draw.h"

namespace nao {
namespace {

/** Interval at which hold_walk() repeats its command, s: that of the phone app's joysticks. */
constexpr double kWalkCommandPeriod = 0.2;

// By default those of data/disturbances/default.yaml, loaded once.
const sim::DisturbanceSet& disturbances_of(const ClosedLoopOptions& options) {
  static const sim::DisturbanceSet none;
  static const sim::DisturbanceSet by_default = sim::DisturbanceSet::find("default");
  if (options.is_ideal) return none;
  return options.disturbances != nullptr ? *options.disturbances : by_default;
}

sim::WorldOptions world_options(const ClosedLoopOptions& options, uint64_t seed) {
  sim::WorldOptions result;
  result.engine = options.engine;
  result.seed = seed;
  draw_world(disturbances_of(options), seed, result);
  if (options.tick_ms == 0) return result;
  const int step_ms = static_cast<int>(std::lround(1e3 * result.step));
  if (options.tick_ms < step_ms || options.tick_ms % step_ms != 0) {
    throw ConfigError("control period " + std::to_string(options.tick_ms) +
                      " ms is not a positive multiple of " + std::to_string(step_ms) + " ms");
  }
  result.steps_per_tick = options.tick_ms / step_ms;
  return result;
}

// Sensors as the motion daemon would decode them from the message, without a bus in between.
motion::Sensors to_core(const sim::SensorReadings& readings, const sim::MotorTargets& held,
                        double period) {
  const auto list = [](const Eigen::VectorXd& values) {
    return std::vector<double>(values.data(), values.data() + values.size());
  };
  motion::Sensors sensors;
  sensors.tick = readings.tick;
  sensors.period = period;
  sensors.utime = std::llround(readings.time * 1e6);
  sensors.position = list(readings.position);
  sensors.velocity = list(readings.velocity);
  sensors.torque = list(readings.torque);
  sensors.target_position = list(held.position);
  sensors.stiffness = list(held.stiffness);
  sensors.accelerometer_torso = readings.accelerometer;
  sensors.gyroscope_torso = readings.gyroscope;
  sensors.orientation_torso_in_world = readings.orientation;
  sensors.foot_force = list(readings.foot_force);
  return sensors;
}

}  // namespace

std::shared_ptr<sim::World> ClosedLoop::make_world(const ClosedLoopOptions& options,
                                                   uint64_t seed) {
  return std::make_shared<sim::World>(options.scene, world_options(options, seed));
}

ClosedLoop::ClosedLoop(const ClosedLoopOptions& options, uint64_t seed)
    : ClosedLoop(options, seed, make_world(options, seed)) {}

ClosedLoop::ClosedLoop(const ClosedLoopOptions& options, uint64_t seed,
                       std::shared_ptr<sim::World> world)
    : options_(options),
      world_(std::move(world)),
      robot_(world_->num_robots()),
      random_(seed + static_cast<uint64_t>(robot_)) {
  sim::RobotOptions robot;
  robot.posture = options.posture;
  const sim::DisturbanceSet& disturbances = disturbances_of(options);
  draw_robot(disturbances, seed, robot_, *options.model, world_->options(), robot);
  if (!disturbances.is_none()) {
    // The disturbances have taken the first numbers of the same sequence.
    for (int i = 0; i < sim::kNumSharedDraws; ++i) random_.next();
  }
  if (options.command_latency_ticks > 0) {
    robot.command_latency_ticks = options.command_latency_ticks;
  }
  world_->add_robot(options.model, robot);
  restart_core();
}

// A new core knows nothing of the robot: it takes over the servos' targets.
void ClosedLoop::restart_core() {
  core_ = std::make_unique<motion::MotionCore>(*options_.model, options_.motion);
}

int64_t ClosedLoop::send(Command command) {
  command.source = "trial";
  command.id = ++last_id_;
  commands_.push_back(std::move(command));
  return last_id_;
}

int64_t ClosedLoop::send_posture(const std::string& posture, double speed) {
  return send({"", 0, PostureCommand{posture, speed}});
}

int64_t ClosedLoop::send_action(const std::string& action) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return send({"", 0, ActionCommand{action, nan, nan, nan}});
}

void ClosedLoop::teach(motion::ActionScript script) {
  const std::string name = script.sequence.name;
  taught_.push_back({name, std::make_shared<const motion::ActionScript>(std::move(script))});
}

int64_t ClosedLoop::hold_walk(const Eigen::Vector3d& velocity) {
  // One command for the whole walk; its velocity changes under the same number.
  if (!walk_) walk_ = Command{"trial", ++last_id_, {}};
  walk_->request = WalkCommand{velocity.x(), velocity.y(), velocity.z()};
  // The next tick sends it.
  ticks_since_walk_ = ticks_per_walk_command();
  return walk_->id;
}

int ClosedLoop::ticks_per_walk_command() const {
  // The repetition is timed, not counted in ticks: the command expires after a time, independent of
  // the control period.
  return static_cast<int>(std::lround(kWalkCommandPeriod / period()));
}

// With a stop the robot ends the walk; without one the command expires, as when a phone vanishes.
void ClosedLoop::release_walk(bool sends_stop) {
  if (walk_ && sends_stop) {
    walk_->request = WalkCommand{};
    commands_.push_back(*walk_);
  }
  walk_.reset();
}

// Physics with the last targets, then the motion core with the new readings.
void ClosedLoop::step() {
  world_->step_tick();
  step_core();
}

void ClosedLoop::step_core() {
  if (walk_ && ++ticks_since_walk_ > ticks_per_walk_command()) {
    commands_.push_back(*walk_);
    ticks_since_walk_ = 1;
  }
  // A missed tick stands for a late motion daemon: the servos hold their targets, and the next step
  // of the core is longer.
  const double probability = options_.missed_tick_probability;
  if (probability > 0 && ticks_to_miss_ == 0 && random(0, 1) < probability) {
    ticks_to_miss_ = 1 + static_cast<int>(random(0, 4));
  }
  // A crashed core is not stepped; the servos continue to hold.
  if (ticks_to_miss_ > 0 || world_->are_readings_lost(robot_)) {
    ticks_to_miss_ = std::max(0, ticks_to_miss_ - 1);
    ++missed_ticks_;
  } else if (!is_core_crashed_) {
    motion::Input input;
    input.sensors = to_core(world_->sensors(robot_), world_->targets(robot_), period());
    if (fault_) fault_(*input.sensors);
    input.commands = std::exchange(commands_, {});
    input.taught = std::exchange(taught_, {});
    input.ball = ball_;
    const double begin = clock_ != nullptr ? clock_() : 0;
    const double dt = (1 + std::exchange(missed_ticks_, 0)) * period();
    const motion::Output output = core_->step(input, dt);
    if (clock_ != nullptr) step_times_->push_back(clock_() - begin);
    keep(output.results);
    targets_ = output.joint_targets->position;
    estimate_ = *output.robot_state;
    sim::MotorTargets targets;
    const auto& stiffness = output.joint_targets->stiffness;
    targets.position = Eigen::VectorXd::Map(targets_.data(), model().num_motors());
    targets.stiffness = Eigen::VectorXd::Map(stiffness.data(), model().num_motors());
    const std::vector<double>& kp = output.joint_targets->kp;
    const std::vector<double>& kd = output.joint_targets->kd;
    targets.kp = Eigen::VectorXd::Map(kp.data(), static_cast<long>(kp.size()));
    targets.kd = Eigen::VectorXd::Map(kd.data(), static_cast<long>(kd.size()));
    world_->set_targets(robot_, targets);
  }
  if (on_tick_) on_tick_();
}

void ClosedLoop::keep(const std::vector<CommandResult>& results) {
  for (const CommandResult& result : results) {
    if (result.kind == CommandKind::kWalk) {
      const std::pair walk_result{result.id, result.status};
      if (std::exchange(last_walk_result_, walk_result) == walk_result) continue;
    }
    results_.push_back(result);
  }
}

void ClosedLoop::run(double duration) {
  const int num_ticks = static_cast<int>(std::lround(duration / period()));
  for (int i = 0; i < num_ticks; ++i) step();
}

bool ClosedLoop::run_until(const std::function<bool()>& condition, double timeout) {
  const int num_ticks = static_cast<int>(std::lround(timeout / period()));
  for (int i = 0; i < num_ticks; ++i) {
    if (condition()) return true;
    step();
  }
  return condition();
}

std::optional<CommandResult> ClosedLoop::await_end(int64_t id, double timeout) {
  // Each result is checked once: `next` moves on.
  size_t next = 0;
  std::optional<CommandResult> end;
  run_until(
      [&] {
        for (; next < results_.size(); ++next) {
          const CommandResult& result = results_[next];
          if (result.id == id && result.status != ResultStatus::kAccepted) end = result;
        }
        return end.has_value();
      },
      timeout);
  return end;
}

Eigen::Isometry3d ClosedLoop::torso_in_world() const {
  return world_->robot(robot_).link_pose(0);
}

double ClosedLoop::torso_tilt() const {
  return std::acos(std::clamp(torso_in_world().linear()(2, 2), -1.0, 1.0));
}

double ClosedLoop::deviation_from(const Posture& posture, std::string* joint) const {
  const Eigen::VectorXd& position = world_->robot(robot_).motor_position();
  double largest = 0;
  for (int motor = 0; motor < model().num_motors(); ++motor) {
    // Openings of hands are not part of a posture of the body.
    if (world_->robot(robot_).is_opening(motor)) continue;
    const double deviation = std::abs(position[motor] - posture.position[motor]);
    if (deviation <= largest) continue;
    largest = deviation;
    if (joint != nullptr) *joint = model().motor_names()[motor];
  }
  return largest;
}

}  // namespace nao
