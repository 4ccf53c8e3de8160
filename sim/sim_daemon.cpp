#include "sim/sim_daemon.h"

#include <spdlog/spdlog.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <naolcm/sensor_state_t.hpp>

#include "common/data_path.h"
#include "common/error.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "sim/joint_command.h"

namespace nao::sim {
namespace {

constexpr double kLateTick = 0.002;
/** While nothing moves, the state is repeated so often for those who have just come, s. */
constexpr double kIdlePeriod = 0.1;
/** A robot whose motion has been silent for longer has none, s. */
constexpr double kSilence = 0.5;
/** In real time a tick waits so long after the last one for the answer of a motion that was there a
 * moment ago, s: on a busy machine a world that is a little late is better than a robot that falls.
 */
constexpr double kPatience = 0.03;
/** ... but only if some of its answers come within a tick, s: at the far end of a slow network they
 * never do, and waiting for each would slow the world for good. */
constexpr double kNear = 0.01;
constexpr double kMomentAgo = 0.1;
constexpr size_t kRememberedCommands = 64;
constexpr double kGreatestImpulse = 100;
constexpr double kGreatestPlace = 100;

template <size_t N, class Vector>
void copy(const Vector& from, double (&to)[N]) {
  for (size_t i = 0; i < N; ++i) to[i] = from[static_cast<long>(i)];
}

void copy(const Eigen::Quaterniond& from, double (&to)[4]) {
  to[0] = from.w();
  to[1] = from.x();
  to[2] = from.y();
  to[3] = from.z();
}

std::vector<double> to_vector(const Eigen::VectorXd& from) {
  return {from.data(), from.data() + from.size()};
}

Eigen::Vector3d to_eigen(const double (&from)[3]) {
  return {from[0], from[1], from[2]};
}

bool is_within(const Eigen::Vector3d& v, double limit) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit;
}

std::unique_ptr<World> make_world(const SimOptions& options,
                                  const std::shared_ptr<const RobotModel>& model) {
  WorldOptions how;
  how.seed = options.seed;
  auto world = std::make_unique<World>(SceneFile::find(options.scene), how);
  for (size_t i = 0; i < options.robots.size(); ++i) {
    RobotOptions robot;
    robot.name = options.robots[i];
    robot.posture = options.posture;
    robot.ideal_sensors = options.ideal_sensors;
    robot.command_latency_ticks = options.command_latency_ticks;
    // Further robots stand to the left and right of the first.
    const size_t rank = (i + 1) / 2;
    robot.position.y() = (i % 2 == 0 ? -0.8 : 0.8) * static_cast<double>(rank);
    world->add_robot(model, robot);
  }
  return world;
}

}  // namespace

SimDaemon::SimDaemon(Bus& bus, EventLoop& loop, const SimOptions& options)
    : bus_(bus),
      loop_(loop),
      options_(options),
      model_(std::make_shared<const RobotModel>(
          RobotModel::load(data_path() / "robots" / options.model))),
      world_(make_world(options, model_)),
      status_(bus, "nao-sim"),
      pacer_(world_->options().step * world_->options().steps_per_tick) {
  for (int i = 0; i < model_->num_motors(); ++i) {
    joint_names_.push_back(model_->motor_joint(i).name);
  }
  for (const int link : model_->foot_sensors()) {
    foot_sensor_names_.push_back(model_->links()[link].name);
  }
  alarm_ = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
  if (alarm_ < 0) throw Error(std::string("cannot make a timer: ") + std::strerror(errno));

  for (int i = 0; i < world_->num_robots(); ++i) {
    ports_.push_back({RobotChannels(options.robots[i]), world_->targets(i)});
    bus_.subscribe<naolcm::joint_command_t>(
        ports_.back().channels.joint_command, Bus::Queue::kAll,
        [this, i](const naolcm::joint_command_t& message) { take_joint_command(i, message); });
  }
  bus_.subscribe<naolcm::world_command_t>(
      kWorldCommandChannel, Bus::Queue::kAll,
      [this](const naolcm::world_command_t& message) { take_world_command(message); });
  loop_.on_readable(bus_.descriptor(), [this] {
    bus_.handle();
    run_due_ticks();
  });
  loop_.on_readable(alarm_, [this] {
    uint64_t expirations = 0;
    if (read(alarm_, &expirations, sizeof expirations) < 0) return;
    // The newest commands, before the tick that is due.
    bus_.handle();
    run_due_ticks();
  });
  loop_.every(kIdlePeriod, [this] { repeat_while_waiting(); });
  loop_.every(1.0, [this] { publish_status(); });

  status_.set_state("ready");
  publish_sensors();
  publish_truth();
  publish_status();
  const double now = monotonic_seconds();
  pacer_.set_pace(options.lock_step ? 0 : options.pace, now);
  rate_time_ = now;
  set_alarm(now);
}

SimDaemon::~SimDaemon() {
  close(alarm_);
}

void SimDaemon::take_joint_command(int robot, const naolcm::joint_command_t& message) {
  Port& port = ports_[robot];
  // Answers to a tick that is long over (a motion from before a reset) must not count as new.
  if (message.tick > world_->tick()) {
    throw Error("command answers a tick that has not been");
  }
  if (auto reason = merge_joint_command(*model_, message.joint_names, message.joint_position,
                                        message.joint_stiffness, port.targets)) {
    throw Error("refused: " + *reason);
  }
  world_->set_targets(robot, port.targets);
  port.answered_tick = std::max(port.answered_tick, message.tick);
  port.answer_time = monotonic_seconds();
  port.answer_delay.note_answer(message.tick, port.answer_time);
  port.has_answered = true;
}

void SimDaemon::take_world_command(const naolcm::world_command_t& message) {
  const std::pair<std::string, int64_t> key{message.source, message.command_id};
  if (std::find(done_commands_.begin(), done_commands_.end(), key) != done_commands_.end()) return;
  done_commands_.push_back(key);
  if (done_commands_.size() > kRememberedCommands) done_commands_.pop_front();

  last_command_source_ = message.source;
  last_command_id_ = message.command_id;
  last_command_error_ = carry_out(message);
  if (last_command_error_.empty()) {
    spdlog::info("world command {} from {}", message.command, message.source);
  } else {
    spdlog::warn("world command {} from {} refused: {}", message.command, message.source,
                 last_command_error_);
  }
  publish_truth();
}

std::string SimDaemon::carry_out(const naolcm::world_command_t& message) {
  const double now = monotonic_seconds();
  const std::string& command = message.command;
  const int robot = find_robot(message.robot);
  if (command == "pause") {
    is_paused_ = true;
  } else if (command == "resume") {
    is_paused_ = false;
    ticks_to_step_ = 0;
    pacer_.restart(now);
  } else if (command == "step") {
    if (message.num_ticks < 1) return "step needs 1 or more ticks";
    is_paused_ = true;
    ticks_to_step_ += message.num_ticks;
    pacer_.restart(now);
  } else if (command == "reset") {
    world_->reset();
    ticks_to_step_ = 0;
    for (int i = 0; i < world_->num_robots(); ++i) {
      ports_[i].targets = world_->targets(i);
      ports_[i].answered_tick = -1;
    }
    pacer_.restart(now);
    publish_sensors();
  } else if (command == "set-pace") {
    if (!(message.pace >= 0 && message.pace <= 1000)) return "pace must be 0 to 1000";
    if (options_.lock_step) return "in lock-step the commands set the pace";
    pacer_.set_pace(message.pace, now);
    // Who never waits must not keep others from the processor.
    if (message.pace > 0) {
      request_realtime_scheduling(RealtimePriority::kControl);
    } else {
      use_normal_scheduling();
    }
  } else if (command == "place-robot") {
    return place_robot(message, robot);
  } else if (command == "place-ball") {
    if (!world_->has_ball()) return "scene " + options_.scene + " has no ball";
    const Eigen::Vector3d position = to_eigen(message.position_in_world);
    const Eigen::Vector3d velocity = to_eigen(message.velocity_in_world);
    if (!is_within(position, kGreatestPlace) || !is_within(velocity, kGreatestPlace)) {
      return "position and velocity must be finite and within 100 m and m/s";
    }
    if (position.z() < 0) return "the ball cannot lie below the floor";
    world_->place_ball(position, velocity);
  } else if (command == "push") {
    return push(message, robot);
  } else {
    return "unknown world command \"" + command + "\"";
  }
  return "";
}

std::string SimDaemon::place_robot(const naolcm::world_command_t& message, int robot) {
  if (robot < 0) return "there is no robot \"" + message.robot + "\"";
  const Eigen::Vector3d position = to_eigen(message.position_in_world);
  if (!is_within(position, kGreatestPlace) || position.z() < 0) {
    return "position must be finite, within 100 m and not below the floor";
  }
  const Posture* posture = nullptr;
  if (!message.posture.empty()) {
    posture = model_->find_posture(message.posture);
    if (posture == nullptr) return "there is no posture \"" + message.posture + "\"";
  }
  const double(&q)[4] = message.orientation_in_world;
  const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
  const double norm = orientation.norm();
  if (norm != 0 && !(std::abs(norm - 1) < 0.01)) return "orientation is no unit quaternion";
  world_->place_robot(robot, posture, position, norm != 0 ? &orientation : nullptr);
  ports_[robot].targets = world_->targets(robot);
  return "";
}

std::string SimDaemon::push(const naolcm::world_command_t& message, int robot) {
  const Eigen::Vector3d impulse = to_eigen(message.impulse_in_world);
  if (!is_within(impulse, kGreatestImpulse)) return "impulse must be finite and within 100 N s";
  if (message.link == "ball") {
    if (!world_->has_ball()) return "scene " + options_.scene + " has no ball";
    world_->push_ball(impulse);
    return "";
  }
  if (robot < 0) return "there is no robot \"" + message.robot + "\"";
  const int link = model_->find_link(message.link);
  if (link < 0) return "there is no link \"" + message.link + "\"";
  world_->push(robot, link, impulse);
  return "";
}

int SimDaemon::find_robot(const std::string& name) const {
  if (name.empty()) return 0;
  const auto found = std::find(options_.robots.begin(), options_.robots.end(), name);
  return found == options_.robots.end() ? -1 : static_cast<int>(found - options_.robots.begin());
}

bool SimDaemon::may_tick() const {
  if (is_paused_ && ticks_to_step_ == 0) return false;
  if (!options_.lock_step) return true;
  return std::all_of(ports_.begin(), ports_.end(),
                     [this](const Port& port) { return port.answered_tick == world_->tick(); });
}

double SimDaemon::next_tick(double now) const {
  const double due = pacer_.next(now);
  if (options_.lock_step || pacer_.pace() == 0) return due;
  const bool is_awaited = std::any_of(ports_.begin(), ports_.end(), [&](const Port& port) {
    return port.has_answered && port.answered_tick < world_->tick() &&
           now - port.answer_time < kMomentAgo && port.answer_delay.least() < kNear;
  });
  return is_awaited ? std::max(due, last_tick_time_ + kPatience) : due;
}

void SimDaemon::run_due_ticks() {
  double now = monotonic_seconds();
  // As fast as possible: some ticks, then a look at the bus, for a while; then the event loop.
  const double end = now + 0.005;
  while (may_tick() && next_tick(now) <= now && now <= end) {
    run_tick(now);
    if (pacer_.pace() == 0) bus_.handle();
    now = monotonic_seconds();
  }
  set_alarm(now);
}

void SimDaemon::run_tick(double now) {
  const double lateness = pacer_.lateness(now);
  if (lateness > kLateTick) ++num_late_ticks_;
  if (lateness_.size() < lateness_.capacity()) lateness_.push_back(lateness);
  pacer_.tick(now);
  last_tick_time_ = now;
  for (const Port& port : ports_) {
    const bool is_driven = port.has_answered && now - port.answer_time < kSilence;
    if (is_driven && port.answered_tick < world_->tick()) ++num_late_commands_;
  }
  world_->step_tick();
  for (Port& port : ports_) port.answer_delay.note_tick(world_->tick(), now);
  ++ticks_run_;
  if (ticks_to_step_ > 0) --ticks_to_step_;
  publish_sensors();
  publish_truth();
  status_.tick(now);
  tick_seconds_ += monotonic_seconds() - now;
  if (world_->num_bad_states() != num_bad_states_) {
    num_bad_states_ = world_->num_bad_states();
    if (warnings_.allow(now)) {
      spdlog::error(
          "the physics left all bounds at tick {} and was put back to its start ({} so far)",
          world_->tick(), num_bad_states_);
    }
  }
}

void SimDaemon::set_alarm(double now) {
  itimerspec timing{};
  if (may_tick()) {
    const double next = std::max(next_tick(now), now + 1e-6);
    timing.it_value.tv_sec = static_cast<time_t>(next);
    timing.it_value.tv_nsec =
        static_cast<long>((next - static_cast<double>(timing.it_value.tv_sec)) * 1e9);
  }
  timerfd_settime(alarm_, TFD_TIMER_ABSTIME, &timing, nullptr);
}

void SimDaemon::repeat_while_waiting() {
  const double now = monotonic_seconds();
  if (now - last_publish_time_ < kIdlePeriod * 0.9) return;
  // An answer may have been lost, or somebody has come who needs a state to start from.
  if (options_.lock_step && !(is_paused_ && ticks_to_step_ == 0)) publish_sensors();
  publish_truth();
}

void SimDaemon::publish_sensors() {
  for (int i = 0; i < world_->num_robots(); ++i) {
    const SensorReadings& sensed = world_->sensors(i);
    naolcm::sensor_state_t message;
    message.utime = std::llround(sensed.time * 1e6);
    message.tick = sensed.tick;
    message.period = world_->options().step * world_->options().steps_per_tick;
    message.num_joints = static_cast<int>(joint_names_.size());
    message.joint_names = joint_names_;
    message.joint_position = to_vector(sensed.position);
    message.joint_velocity = to_vector(sensed.velocity);
    message.joint_torque = to_vector(sensed.torque);
    message.joint_target_position = to_vector(world_->targets(i).position);
    message.joint_stiffness = to_vector(world_->targets(i).stiffness);
    copy(sensed.accelerometer, message.accelerometer_torso);
    message.is_accelerometer_new = 1;
    copy(sensed.gyroscope, message.gyroscope_torso);
    message.is_gyroscope_new = 1;
    copy(sensed.orientation, message.orientation_torso_in_world);
    message.num_foot_sensors = static_cast<int>(foot_sensor_names_.size());
    message.foot_sensor_names = foot_sensor_names_;
    message.foot_force = to_vector(sensed.foot_force);
    bus_.publish(ports_[i].channels.sensor_state, message);
  }
  last_publish_time_ = monotonic_seconds();
}

std::string SimDaemon::surface_name(const Surface& surface) const {
  switch (surface.kind) {
    case Surface::Kind::kRobot:
      return options_.robots[surface.robot] + "/" + model_->links()[surface.link].name;
    case Surface::Kind::kBall:
      return "ball";
    case Surface::Kind::kGoal:
    case Surface::Kind::kNet:
      return "goal";
    default:
      return "floor";
  }
}

void SimDaemon::publish_truth() {
  naolcm::world_truth_t message{};
  message.utime = std::llround(world_->sensors(0).time * 1e6);
  message.tick = world_->tick();
  message.scene = options_.scene;
  message.engine = "fast";
  message.disturbances = options_.ideal_sensors ? "none" : "default";
  message.seed = static_cast<int64_t>(options_.seed);
  message.floor_seed = 0;
  copy(world_->options().gravity, message.gravity_in_world);
  message.is_paused = is_paused_ && ticks_to_step_ == 0 ? 1 : 0;
  message.real_time_factor = real_time_factor_;
  message.pace = pacer_.pace();
  message.num_late_commands = num_late_commands_;
  message.num_late_ticks = num_late_ticks_;
  for (int i = 0; i < world_->num_robots(); ++i) {
    const SimRobot& robot = world_->robot(i);
    const TreeState& state = robot.state();
    naolcm::robot_truth_t truth{};
    truth.robot = options_.robots[i];
    copy(state.position, truth.position_torso_in_world);
    copy(state.orientation, truth.orientation_torso_in_world);
    copy(state.velocity.segment<3>(3), truth.velocity_torso_in_world);
    copy(state.velocity.head<3>(), truth.angular_velocity_torso_in_world);
    copy(robot.dynamics().center_of_mass(), truth.center_of_mass_in_world);
    truth.num_joints = static_cast<int>(joint_names_.size());
    truth.joint_names = joint_names_;
    truth.joint_position = to_vector(robot.motor_position());
    truth.joint_velocity = to_vector(robot.motor_velocity());
    truth.joint_torque = to_vector(robot.motor_torque());
    message.robots.push_back(std::move(truth));
  }
  message.num_robots = static_cast<int>(message.robots.size());
  message.has_ball = world_->has_ball() ? 1 : 0;
  if (world_->has_ball()) {
    const BallState& ball = world_->ball();
    copy(ball.position, message.position_ball_in_world);
    copy(ball.orientation, message.orientation_ball_in_world);
    copy(ball.velocity, message.velocity_ball_in_world);
    copy(ball.angular_velocity, message.angular_velocity_ball_in_world);
  }
  for (const Contact& contact : world_->contacts()) {
    naolcm::contact_t part;
    part.body_a = surface_name(contact.a);
    part.body_b = surface_name(contact.b);
    copy(contact.position, part.position_in_world);
    copy(contact.force_on_a, part.force_on_a_in_world);
    message.contacts.push_back(std::move(part));
  }
  message.num_contacts = static_cast<int>(message.contacts.size());
  message.last_command_source = last_command_source_;
  message.last_command_id = last_command_id_;
  message.last_command_error = last_command_error_;
  bus_.publish(kWorldTruthChannel, message);
  last_publish_time_ = monotonic_seconds();
}

void SimDaemon::publish_status() {
  const double now = monotonic_seconds();
  const int64_t ticks = ticks_run_ - rate_ticks_;
  if (now > rate_time_) {
    const double period = world_->options().step * world_->options().steps_per_tick;
    real_time_factor_ = static_cast<double>(ticks) * period / (now - rate_time_);
  }
  const std::vector<double>::iterator p99 =
      lateness_.begin() + static_cast<long>(lateness_.size() * 99 / 100);
  if (!lateness_.empty()) std::nth_element(lateness_.begin(), p99, lateness_.end());
  const bool is_waiting = options_.lock_step && !may_tick() && ticks == 0 && !is_paused_;
  status_.set_state("ready", is_paused_   ? "paused"
                             : is_waiting ? "waiting for " + ports_[0].channels.joint_command
                                          : "");
  status_.publish({{"real_time_factor", real_time_factor_},
                   {"tick_us", ticks > 0 ? tick_seconds_ * 1e6 / static_cast<double>(ticks) : 0},
                   {"tick_lateness_p99_ms", lateness_.empty() ? 0 : *p99 * 1e3},
                   {"late_ticks", static_cast<double>(num_late_ticks_)},
                   {"late_commands", static_cast<double>(num_late_commands_)},
                   {"bad_states", static_cast<double>(world_->num_bad_states())}});
  lateness_.clear();
  lateness_.reserve(4096);
  tick_seconds_ = 0;
  rate_time_ = now;
  rate_ticks_ = ticks_run_;
}

}  // namespace nao::sim
