#include "closed_loop/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nao {
namespace {

constexpr double kTick = 0.01;
constexpr int kTicksPerWalkCommand = 20;

/** Next number of the SplitMix64 generator (Steele, Lea, Flood, OOPSLA 2014). */
uint64_t next_random(uint64_t& state) {
  state += 0x9e3779b97f4a7c15u;
  uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

sim::WorldOptions world_options(uint64_t seed) {
  sim::WorldOptions options;
  options.seed = seed;
  return options;
}

motion::Sensors to_core(const sim::SensorReadings& readings, const sim::MotorTargets& held) {
  const auto list = [](const Eigen::VectorXd& values) {
    return std::vector<double>(values.data(), values.data() + values.size());
  };
  motion::Sensors sensors;
  sensors.tick = readings.tick;
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

ClosedLoop::ClosedLoop(const ClosedLoopOptions& options, uint64_t seed)
    : options_(options), world_(options.scene, world_options(seed)), random_state_(seed) {
  sim::RobotOptions robot;
  robot.posture = options.posture;
  if (options.is_ideal) {
    robot.ideal_sensors = true;
    robot.command_latency_ticks = 0;
  } else {
    // The world's floor friction is 0.8: 0.5 to 1.0 on the feet.
    robot.friction_scale = random(0.5, 1.0) / 0.8;
    robot.mass_scale = random(0.97, 1.03);
    robot.command_latency_ticks = random(0, 1) < 0.5 ? 1 : 2;
    if (options.command_latency_ticks > 0) {
      robot.command_latency_ticks = options.command_latency_ticks;
    }
  }
  world_.add_robot(options.model, robot);
  restart_core();
}

void ClosedLoop::restart_core() {
  core_ = std::make_unique<motion::MotionCore>(*options_.model, options_.motion);
}

double ClosedLoop::random(double low, double high) {
  return low + (high - low) * static_cast<double>(next_random(random_state_) >> 11) * 0x1p-53;
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

int64_t ClosedLoop::hold_walk(const Eigen::Vector3d& velocity) {
  if (!walk_) walk_ = Command{"trial", ++last_id_, {}};
  walk_->request = WalkCommand{velocity.x(), velocity.y(), velocity.z()};
  ticks_since_walk_ = kTicksPerWalkCommand;
  return walk_->id;
}

void ClosedLoop::release_walk(bool says_so) {
  if (walk_ && says_so) {
    walk_->request = WalkCommand{};
    commands_.push_back(*walk_);
  }
  walk_.reset();
}

void ClosedLoop::step() {
  world_.step_tick();
  if (walk_ && ++ticks_since_walk_ > kTicksPerWalkCommand) {
    commands_.push_back(*walk_);
    ticks_since_walk_ = 1;
  }
  if (options_.late_share > 0 && ticks_to_miss_ == 0 && random(0, 1) < options_.late_share) {
    ticks_to_miss_ = 1 + static_cast<int>(random(0, 4));
  }
  if (ticks_to_miss_ > 0) {
    --ticks_to_miss_;
    ++missed_ticks_;
  } else if (!is_dead_) {
    motion::Input input;
    input.sensors = to_core(world_.sensors(0), world_.targets(0));
    input.commands = std::exchange(commands_, {});
    const double begin = clock_ != nullptr ? clock_() : 0;
    const motion::Output output = core_->step(input, (1 + std::exchange(missed_ticks_, 0)) * kTick);
    if (clock_ != nullptr) step_times_->push_back(clock_() - begin);
    results_.insert(results_.end(), output.results.begin(), output.results.end());
    targets_ = output.joint_targets->position;
    estimate_ = *output.robot_state;
    sim::MotorTargets targets;
    const auto& stiffness = output.joint_targets->stiffness;
    targets.position = Eigen::VectorXd::Map(targets_.data(), model().num_motors());
    targets.stiffness = Eigen::VectorXd::Map(stiffness.data(), model().num_motors());
    world_.set_targets(0, targets);
  }
  if (on_tick_) on_tick_();
}

void ClosedLoop::run(double duration) {
  const int num_ticks = static_cast<int>(std::lround(duration / kTick));
  for (int i = 0; i < num_ticks; ++i) step();
}

bool ClosedLoop::run_until(const std::function<bool()>& condition, double timeout) {
  const int num_ticks = static_cast<int>(std::lround(timeout / kTick));
  for (int i = 0; i < num_ticks; ++i) {
    if (condition()) return true;
    step();
  }
  return condition();
}

std::optional<CommandResult> ClosedLoop::await_end(int64_t id, double timeout) {
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
  return world_.robot(0).link_pose(0);
}

double ClosedLoop::torso_tilt() const {
  return std::acos(std::clamp(torso_in_world().linear()(2, 2), -1.0, 1.0));
}

double ClosedLoop::deviation_from(const Posture& posture, std::string* joint) const {
  const Eigen::VectorXd& position = world_.robot(0).motor_position();
  double largest = 0;
  for (int motor = 0; motor < model().num_motors(); ++motor) {
    const std::string& name = model().motor_joint(motor).name;
    if (name == "LHand" || name == "RHand") continue;
    const double deviation = std::abs(position[motor] - posture.position[motor]);
    if (deviation <= largest) continue;
    largest = deviation;
    if (joint != nullptr) *joint = name;
  }
  return largest;
}

}  // namespace nao
