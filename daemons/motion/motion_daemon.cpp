#include "daemons/motion/motion_daemon.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "common/logger.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "daemons/motion/message_conversion.h"
#include "messages/result_message.h"

namespace nao::motion {
namespace {

// Time without sensor data after which commands are answered without them, and the period of these
// steps, s of wall time. Chosen: longer than the 0.1 s between two states of a robot at rest, a
// third of the time after which there is no robot.
constexpr double kSilencePeriod = 0.15;
// Control periods between two sensor states above which the gap means a pause or another robot
// instead of lost ticks.
constexpr double kMaxStepPeriods = 10;
// Slack of a comparison of times that are multiples of a microsecond, s.
constexpr double kRounding = 5e-7;
// Period of the status messages, s.
constexpr double kStatusPeriod = 1.0;
// Ratio of robot time to wall time above which a simulator runs as fast as it can.
constexpr double kFastRatio = 2;
// Commands for one step; more are dropped, and repeated by their senders. Chosen: more than all
// clients of the gateway send in a step.
constexpr size_t kMaxWaitingCommands = 256;
// Taught motions for one step; more are dropped, and announced again. Chosen: a motion of 200
// keyframes takes 0.1 ms.
constexpr size_t kMaxWaitingMotions = 16;

}  // namespace

MotionDaemon::MotionDaemon(Bus& bus, EventLoop& loop, const RobotModel& model,
                           const MotionOptions& options, const std::string& robot)
    : bus_(bus),
      loop_(loop),
      model_(model),
      channels_(robot),
      status_(bus, "nao-motion", robot),
      second_process_(bus, "nao-motion", robot),
      core_(model, options) {
  subscribe_to_command<naolcm::walk_command_t>(channels_.walk_command);
  subscribe_to_command<naolcm::move_to_command_t>(channels_.move_to_command);
  subscribe_to_command<naolcm::posture_command_t>(channels_.posture_command);
  subscribe_to_command<naolcm::joint_change_command_t>(channels_.joint_change_command);
  subscribe_to_command<naolcm::action_command_t>(channels_.action_command);
  subscribe_to_command<naolcm::stop_command_t>(channels_.stop_command);
  bus_.subscribe<naolcm::keyframe_motion_t>(
      channels_.keyframe_motion, Bus::Queue::kAll, [this](const auto& message) {
        if (taught_.size() >= kMaxWaitingMotions) {
          throw MessageError("more than " + std::to_string(kMaxWaitingMotions) +
                             " motions in one step");
        }
        taught_.push_back(to_taught(model_, message));
      });
  bus_.subscribe<naolcm::vision_state_t>(
      channels_.vision_state, Bus::Queue::kLatest,
      [this](const auto& message) { ball_ = to_seen_ball(message); });
  // The latest sensor state only: an older one would be answered with targets for the past.
  bus_.subscribe<naolcm::sensor_state_t>(
      channels_.sensor_state, Bus::Queue::kLatest,
      [this](const auto& message) { take_sensor_state(message); });
  loop.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  silence_timer_ = loop.every(kSilencePeriod, [this] { check_for_silence(); });
  loop.every_aligned(kStatusPeriod, [this] { publish_status(); });
  for (const Policy& policy : core_.policies()) {
    if (policy.fault.empty()) {
      logger::info("policy {}: {} observations, {} joints, {:.0f} Hz", policy.name,
                   policy.manifest->num_observations(), policy.manifest->num_actions(),
                   1 / policy.manifest->period);
    } else {
      logger::warn("policy {} cannot be used: {}", policy.name, policy.fault);
    }
  }
  last_step_time_ = monotonic_seconds();
}

template <class Message>
void MotionDaemon::subscribe_to_command(const std::string& channel) {
  // The sender repeats a dropped command.
  bus_.subscribe<Message>(channel, Bus::Queue::kAll, [this](const Message& message) {
    if (commands_.size() >= kMaxWaitingCommands) {
      throw MessageError("more than " + std::to_string(kMaxWaitingCommands) +
                         " commands in one step");
    }
    commands_.push_back(to_command(message));
    wake_simulator();
  });
}

// The answer to the last state, once more: see sensor_state_t. By robot time, not by the wall
// clock, so that a run in lock-step stays the same.
void MotionDaemon::wake_simulator() {
  if (last_answer_ && last_interval_ > 1.5 * last_period_ &&
      core_.motion_state().mode != Mode::kNoRobot) {
    bus_.publish(channels_.joint_command, *last_answer_);
  }
}

void MotionDaemon::take_sensor_state(const naolcm::sensor_state_t& message) {
  if (second_process_.was_first()) {
    throw Error(second_process_.describe() +
                "; this one ends, since the robot would obey both in turns. Stop the other one "
                "first, or use a bus of its own (LCM_DEFAULT_URL)");
  }
  if (!owner_.accepts(message.utime, monotonic_seconds())) return;
  loop_.restart(silence_timer_);
  // In lock-step the simulator repeats a state whose answer it has not received. A second step on
  // it would make the run depend on when messages arrive.
  if (last_answer_ && message.tick == last_tick_ && message.utime == last_utime_) {
    last_step_time_ = monotonic_seconds();
    bus_.publish(channels_.joint_command, *last_answer_);
    return;
  }
  Sensors sensors = to_sensors(model_, message);
  const double period = sensors.period;
  // By the robot's clock, so that ticks that were lost lengthen the step.
  const double elapsed = static_cast<double>(sensors.utime - last_utime_) * 1e-6;
  const bool is_successor =
      last_tick_ >= 0 && elapsed > 0 && elapsed <= kMaxStepPeriods * period + kRounding;
  // A robot at rest sends few states.
  const Mode mode = core_.motion_state().mode;
  if (is_successor && mode != Mode::kHolding && mode != Mode::kRelaxed) {
    num_missed_ticks_ += std::max<int64_t>(0, sensors.tick - last_tick_ - 1);
  }
  last_interval_ = is_successor ? elapsed : period;
  last_period_ = period;
  last_utime_ = sensors.utime;
  last_tick_ = sensors.tick;
  step(std::move(sensors), last_interval_);
}

// Without sensors the core still runs, on wall time: it notices that the robot is unavailable, and
// refuses commands.
void MotionDaemon::check_for_silence() {
  const double now = monotonic_seconds();
  // Commands that come after a reset wait for the new time.
  if (now - last_step_time_ < 0.9 * kSilencePeriod || owner_.is_contested(now)) return;
  const double silence = now - std::max(last_step_time_, last_silent_step_time_);
  last_silent_step_time_ = now;
  step(std::nullopt, silence);
}

void MotionDaemon::step(std::optional<Sensors> sensors, double dt) {
  const double start = monotonic_seconds();
  const bool has_sensors = sensors.has_value();
  Input input;
  input.sensors = std::move(sensors);
  input.commands = std::exchange(commands_, {});
  input.taught = std::exchange(taught_, {});
  input.ball = ball_;
  const Mode mode = core_.motion_state().mode;
  const Output output = core_.step(input, dt);
  publish(output);
  // At once, since scripts/start waits for it.
  if ((mode == Mode::kNoRobot) != (core_.motion_state().mode == Mode::kNoRobot)) publish_status();
  // Results are sent again, since the bus may lose messages.
  for (const CommandResult& result : reminder_.due(dt)) publish(result);
  for (const CommandResult& result : output.results) {
    // Every repetition of a walk has a result: only the first one of equal results is logged.
    std::string line = fmt::format("{} {} of {}: {}{}{}", to_string(result.kind), result.id,
                                   quoted(result.source), to_string(result.status),
                                   result.reason.empty() ? "" : ": ", to_sentence(result.reason));
    if (line != last_result_line_) logger::info("{}", line);
    last_result_line_ = std::move(line);
    publish(result);
    reminder_.note(result);
  }
  // Steps of silence do not count in the statistics of control.
  if (!has_sensors) return;
  const double end = monotonic_seconds();
  ++num_steps_;
  robot_time_ += dt;
  last_step_time_ = end;
  status_.tick(end);
  worst_step_seconds_ = std::max(worst_step_seconds_, end - start);
}

void MotionDaemon::publish(const Output& output) {
  // The joint command first: in lock-step the simulator waits for it.
  if (output.joint_targets && output.robot_state) {
    const std::vector<std::string>& names = model_.motor_names();
    last_answer_ = to_message(*output.joint_targets, *output.robot_state, names);
    bus_.publish(channels_.joint_command, *last_answer_);
    bus_.publish(channels_.robot_state, to_message(*output.robot_state, names));
  }
  if (output.motion_state) bus_.publish(channels_.motion_state, to_message(*output.motion_state));
  if (output.policy) bus_.publish(channels_.policy_state, to_message(*output.policy, last_utime_));
}

void MotionDaemon::publish(const CommandResult& result) {
  bus_.publish(channels_.command_result, to_message(result, last_utime_));
}

void MotionDaemon::publish_status() {
  // With a simulator that runs as fast as it can, this program never waits, so it must yield the
  // processor to others.
  if (std::exchange(robot_time_, 0) > kFastRatio * kStatusPeriod) {
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
                   {"other_robot_states", static_cast<double>(owner_.num_rejected())},
                   {"worst_step_us", worst_step_seconds_ * 1e6}});
  worst_step_seconds_ = 0;
}

}  // namespace nao::motion
