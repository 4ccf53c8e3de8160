#include "daemons/motion/motion_daemon.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "daemons/motion/message_conversion.h"

namespace nao::motion {
namespace {

constexpr double kTick = 0.01;  // s, the period of sensor states
constexpr double kSilencePeriod =
    0.05;  // s of silence after which commands are answered all the same
// A gap of robot time longer than this is a pause or another robot, not a slow tick, s.
constexpr double kLongestStep = 0.1;
// Robot time in a second of wall time from which on ticks do not come in real time.
constexpr double kFastPace = 2;
// Commands that may wait for one step. A sender cannot hurt more than this; the rest is dropped and
// sent again by those who mean it.
constexpr size_t kMaxWaitingCommands = 256;

}  // namespace

MotionDaemon::MotionDaemon(Bus& bus, EventLoop& loop, const RobotModel& model,
                           const MotionOptions& options, const std::string& robot)
    : bus_(bus),
      model_(model),
      channels_(robot),
      status_(bus, "nao-motion"),
      core_(model, options) {
  for (int motor = 0; motor < model.num_motors(); ++motor) {
    joint_names_.push_back(model.motor_joint(motor).name);
  }
  subscribe_to_command<naolcm::walk_command_t>(channels_.walk_command);
  subscribe_to_command<naolcm::move_to_command_t>(channels_.move_to_command);
  subscribe_to_command<naolcm::posture_command_t>(channels_.posture_command);
  subscribe_to_command<naolcm::joint_change_command_t>(channels_.joint_change_command);
  subscribe_to_command<naolcm::action_command_t>(channels_.action_command);
  subscribe_to_command<naolcm::stop_command_t>(channels_.stop_command);
  bus_.subscribe<naolcm::sensor_state_t>(
      channels_.sensor_state, Bus::Queue::kLatest,
      [this](const naolcm::sensor_state_t& message) { take_sensor_state(message); });
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  loop.every(kSilencePeriod, [this] { watch_for_silence(); });
  loop.every(1.0, [this] { publish_status(); });
  last_step_time_ = monotonic_seconds();
}

template <class Message>
void MotionDaemon::subscribe_to_command(const std::string& channel) {
  bus_.subscribe<Message>(channel, Bus::Queue::kAll, [this](const Message& message) {
    if (commands_.size() >= kMaxWaitingCommands) throw Error("too many commands at once");
    commands_.push_back(to_command(message));
  });
}

void MotionDaemon::take_sensor_state(const naolcm::sensor_state_t& message) {
  // In lock-step the simulator repeats a state that nobody answered. A second step on it would make
  // the run depend on when messages arrive.
  if (last_answer_ && message.tick == last_tick_ && message.utime == last_utime_) {
    last_step_time_ = monotonic_seconds();
    bus_.publish(channels_.joint_command, *last_answer_);
    return;
  }
  Sensors sensors = to_sensors(model_, message);
  const double elapsed = static_cast<double>(sensors.utime - last_utime_) * 1e-6;
  const bool is_successor = last_tick_ >= 0 && elapsed > 0 && elapsed <= kLongestStep;
  if (is_successor) num_missed_ticks_ += std::max<int64_t>(0, sensors.tick - last_tick_ - 1);
  last_utime_ = sensors.utime;
  last_tick_ = sensors.tick;
  step(std::move(sensors), is_successor ? elapsed : kTick);
}

void MotionDaemon::watch_for_silence() {
  const double now = monotonic_seconds();
  const double silence = now - std::max(last_step_time_, last_silent_check_);
  if (now - last_step_time_ < kSilencePeriod) return;
  last_silent_check_ = now;
  step(std::nullopt, silence);
}

void MotionDaemon::step(std::optional<Sensors> sensors, double dt) {
  const double start = monotonic_seconds();
  const bool has_sensors = sensors.has_value();
  Input input;
  input.sensors = std::move(sensors);
  input.commands = std::exchange(commands_, {});
  const Output output = core_.step(input, dt);
  // The joint command first: the simulator may be waiting for it.
  if (output.joint_targets && output.robot_state) {
    last_answer_ = to_message(*output.joint_targets, *output.robot_state, joint_names_);
    bus_.publish(channels_.joint_command, *last_answer_);
    bus_.publish(channels_.robot_state, to_message(*output.robot_state, joint_names_));
  }
  if (output.motion_state) bus_.publish(channels_.motion_state, to_message(*output.motion_state));
  for (const CommandResult& result : reminder_.due(dt)) publish(result);
  for (const CommandResult& result : output.results) {
    spdlog::info("{} {} of {}: {}{}{}", to_string(result.kind), result.id, quoted(result.source),
                 to_string(result.status), result.reason.empty() ? "" : ": ", result.reason);
    publish(result);
    reminder_.note(result);
  }
  const double end = monotonic_seconds();
  if (has_sensors) {
    ++num_steps_;
    last_step_time_ = end;
    status_.tick(end);
    worst_step_seconds_ = std::max(worst_step_seconds_, end - start);
  }
}

void MotionDaemon::publish(const CommandResult& result) {
  bus_.publish(channels_.command_result, to_message(result, last_utime_));
}

void MotionDaemon::publish_status() {
  // With a simulator as fast as possible this never waits, and must not keep others from the
  // processor.
  const int64_t steps = num_steps_ - num_reported_steps_;
  num_reported_steps_ = num_steps_;
  if (static_cast<double>(steps) * kTick > kFastPace) {
    use_normal_scheduling();
  } else {
    request_realtime_scheduling(RealtimePriority::kControl);
  }
  if (core_.motion_state().mode == Mode::kNoRobot) {
    status_.set_state("waiting", "waiting for " + channels_.sensor_state);
  } else {
    status_.set_state("ready", to_string(core_.motion_state().mode));
  }
  status_.publish({{"steps", static_cast<double>(num_steps_)},
                   {"missed_ticks", static_cast<double>(num_missed_ticks_)},
                   {"worst_step_us", worst_step_seconds_ * 1e6}});
  worst_step_seconds_ = 0;
}

}  // namespace nao::motion
