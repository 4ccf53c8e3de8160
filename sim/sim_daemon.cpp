#include "sim/sim_daemon.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "common/error.h"
#include "common/logger.h"
#include "common/scheduling.h"
#include "common/wall_clock.h"
#include "messages/light_command.h"
#include "messages/result_message.h"
#include "sim/message_conversion.h"

namespace nao::sim {
namespace {

/** While no tick is run, the state is repeated at this interval, s, for programs that have just
 * started. */
constexpr double kIdlePeriod = 0.1;
/** s. */
constexpr double kStatusPeriod = 1;
/** Longest time that ticks are run without returning to the event loop, s. Chosen: half the default
 * control period. */
constexpr double kMaxBurst = 0.005;
/** Time between two body states, s of the robot's time. */
constexpr double kBodyStatePeriod = 0.1;

}  // namespace

SimDaemon::SimDaemon(Bus& bus, EventLoop& loop, const SimOptions& options)
    : bus_(bus),
      loop_(loop),
      core_(options),
      status_(bus, "nao-sim"),
      second_process_(bus, "nao-sim"),
      statistics_(core_.world().options().period(), monotonic_seconds()) {
  timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
  if (timer_ < 0) throw Error(std::string("cannot make a timer: ") + std::strerror(errno));
  subscribe_world();
  update_robots();
  if (core_.lola()) serve_lola();
  // A command may be the answer that lock-step waits for, so that ticks are run at once.
  loop_.on_readable(bus_.descriptor(), [this] {
    bus_.handle();
    run_due_ticks();
  });
  loop_.on_readable(timer_, [this] {
    uint64_t expirations = 0;
    if (read(timer_, &expirations, sizeof expirations) < 0) return;
    // Commands that have arrived take effect in the tick that is due.
    bus_.handle();
    run_due_ticks();
  });
  idle_timer_ = loop_.every(kIdlePeriod, [this] { repeat_while_waiting(); });
  loop_.every_aligned(kStatusPeriod, [this] { publish_status(); });

  // Sensor state is published before the first command: a controller answers it, and lock-step
  // could not begin otherwise.
  status_.set_state("ready");
  publish_sensors();
  publish_truth();
  publish_status();
  const double now = monotonic_seconds();
  core_.start(now);
  set_timer(now);
}

SimDaemon::~SimDaemon() {
  close(timer_);
}

void SimDaemon::subscribe_world() {
  bus_.subscribe<naolcm::world_command_t>(
      kWorldCommandChannel, Bus::Queue::kAll,
      [this](const naolcm::world_command_t& message) { take_world_command(message); });
}

void SimDaemon::update_robots() {
  channels_.clear();
  for (const RobotOption& robot : core_.options().robots) {
    channels_.emplace_back(robot.name);
    // A robot behind LoLA obeys its client only.
    if (core_.lola() || !subscribed_.insert(robot.name).second) continue;
    bus_.subscribe<naolcm::joint_command_t>(
        channels_.back().joint_command, Bus::Queue::kAll,
        [this, name = robot.name](const naolcm::joint_command_t& message) {
          take_joint_command(name, message);
        });
    bus_.subscribe<naolcm::light_command_t>(
        channels_.back().light_command, Bus::Queue::kAll,
        [this, name = robot.name](const naolcm::light_command_t& message) {
          take_light_command(name, message);
        });
    bus_.subscribe_encoded(
        channels_.back().head_camera_command, Bus::Queue::kLatest,
        [this](const RawMessage&) { core_.take_image_request(monotonic_seconds()); });
  }
}

void SimDaemon::serve_lola() {
  LolaServer::Handlers handlers;
  handlers.on_client = [this] { lola_->send(core_.lola()->state()); };
  handlers.on_command = [this](const LolaCommand& command) {
    core_.take_lola_command(command, monotonic_seconds());
    run_due_ticks();
  };
  lola_.emplace(loop_, core_.options().lola_socket, std::move(handlers));
}

void SimDaemon::take_joint_command(const std::string& name,
                                   const naolcm::joint_command_t& message) {
  const int robot = core_.find_robot(name);
  if (robot < 0) return;
  if (auto reason = core_.take_joint_command(robot, to_core(message), monotonic_seconds())) {
    // The bus counts and reports the message.
    throw MessageError("rejected: " + *reason);
  }
}

void SimDaemon::take_light_command(const std::string& name,
                                   const naolcm::light_command_t& message) {
  const int robot = core_.find_robot(name);
  if (robot < 0) return;
  CommandResult result{message.source, message.command_id, CommandKind::kLight,
                       ResultStatus::kDone};
  if (auto fault = core_.take_light_command(robot, to_light_command(message))) {
    result.status = ResultStatus::kRefused;
    result.reason = *std::move(fault);
  }
  bus_.publish(channels_[static_cast<size_t>(robot)].command_result,
               to_message(result, std::llround(core_.world().sensors(robot).time * 1e6)));
}

// false: executed before; senders repeat their commands.
void SimDaemon::take_world_command(const naolcm::world_command_t& message) {
  if (!core_.take_world_command(to_core(message), monotonic_seconds())) return;
  const std::string& error = core_.last_world_command().error;
  if (!error.empty()) {
    if (rejection_warnings_.allow(monotonic_seconds())) {
      logger::warn("world command {} from {} rejected: {}", message.command, message.source, error);
    }
  } else if (message.command == "drag" || message.command == "drag-in-torso") {
    // These come ten times a second and need neither a line in the log nor another state of the
    // world.
    return;
  } else {
    logger::info("world command {} from {}", message.command, message.source);
    if (message.command == "add-robot" || message.command == "remove-robot") update_robots();
    if (message.command == "reset" || message.command == "add-robot") publish_sensors();
    if (message.command == "set-pace") {
      // A simulator that never waits must not run at real-time priority.
      if (core_.scheduler().pace() > 0 && !core_.scheduler().is_lock_step()) {
        request_realtime_scheduling(RealtimePriority::kControl);
      } else {
        use_normal_scheduling();
      }
    }
  }
  publish_truth();
}

// Runs ticks while they are due, for kMaxBurst at most: the event loop must see signals and
// messages even when the simulator cannot keep up. The timer continues where it stopped.
void SimDaemon::run_due_ticks() {
  double now = monotonic_seconds();
  const double end = now + kMaxBurst;
  while (core_.may_tick() && core_.next_tick(now) <= now && now <= end) {
    run_tick(now);
    // Without waiting, nothing else would read commands between the ticks of a burst.
    if (core_.scheduler().pace() == 0) bus_.handle();
    now = monotonic_seconds();
  }
  set_timer(now);
}

void SimDaemon::run_tick(double now) {
  const double delay = core_.run_tick(now);
  statistics_.note_tick(delay, monotonic_seconds() - now);
  warn_of_failures(now);
  if (!core_.is_state_due()) return;
  publish_sensors();
  publish_truth();
  const auto body_ticks =
      std::max<int64_t>(1, std::llround(kBodyStatePeriod / core_.world().options().period()));
  if (core_.world().tick() % body_ticks == 0) publish_bodies();
  status_.tick(now);
}

void SimDaemon::set_timer(double now) {
  itimerspec timing{};
  const std::optional<double> reading = core_.next_reading(now);
  loop_.set_watched(bus_.descriptor(), !reading);
  if (core_.may_tick()) {
    // A time in the past fires at once; only 0 would stop the timer.
    const double next = reading ? *reading : std::max(core_.next_tick(now), now + 1e-6);
    timing.it_value.tv_sec = static_cast<time_t>(next);
    timing.it_value.tv_nsec =
        static_cast<long>((next - static_cast<double>(timing.it_value.tv_sec)) * 1e9);
  }
  // Without a tick to run, a time of 0 disarms the timer.
  timerfd_settime(timer_, TFD_TIMER_ABSTIME, &timing, nullptr);
  const TickScheduler& scheduler = core_.scheduler();
  const bool may_wait = scheduler.is_lock_step() || scheduler.is_stopped();
  loop_.set_period(idle_timer_, may_wait ? kIdlePeriod : kStatusPeriod);
}

void SimDaemon::repeat_while_waiting() {
  const double now = monotonic_seconds();
  const TickScheduler& scheduler = core_.scheduler();
  if (!scheduler.is_lock_step() && !scheduler.is_stopped()) return;
  // Nine tenths: this is called every kIdlePeriod with some jitter.
  if (now - last_publish_time_ < kIdlePeriod * 0.9) return;
  // In lock-step the answer, or the sensor state itself, may have been lost.
  // A frame of LoLA is a tick, and its socket loses none.
  if (scheduler.is_lock_step() && !scheduler.is_stopped() && !lola_) publish_sensors();
  publish_truth();
  publish_bodies();
}

// Reports what went wrong since the last tick; each kind is rate-limited in the log.
void SimDaemon::warn_of_failures(double now) {
  const World& world = core_.world();
  // Both counters go back to 0 with a reset.
  const int64_t num_bad_states = std::exchange(num_bad_states_, world.num_bad_states());
  if (num_bad_states_ > num_bad_states && bad_state_warnings_.allow(now)) {
    logger::error(
        "a robot or the ball left all physical bounds at tick {} and was put back to its "
        "start ({} so far)",
        world.tick(), num_bad_states_);
  }
  const int64_t num_dropped = std::exchange(num_dropped_contacts_, world.num_dropped_contacts());
  if (num_dropped_contacts_ > num_dropped && dropped_contact_warnings_.allow(now)) {
    logger::warn(
        "more contacts than the reserved memory holds at tick {}: bodies may pass through each "
        "other ({} contacts left out so far)",
        world.tick(), num_dropped_contacts_);
  }
}

void SimDaemon::publish_sensors() {
  for (size_t i = 0; i < channels_.size(); ++i) {
    const int robot = static_cast<int>(i);
    // Sensor loss (a disturbance): this tick's message is left out.
    if (core_.world().are_readings_lost(robot)) continue;
    if (lola_) {
      lola_->send(core_.lola()->state());
      continue;
    }
    bus_.publish(channels_[i].sensor_state, sensor_state_of(core_.world(), robot));
  }
  last_publish_time_ = monotonic_seconds();
}

void SimDaemon::publish_truth() {
  naolcm::world_truth_t truth = world_truth_of(core_, real_time_factor_);
  // nao-robot's clock, as LoLA's frames carry no time: images are stamped with the truth's. In
  // lock-step both count frames.
  if (lola_ && !core_.scheduler().is_lock_step()) {
    truth.utime = std::llround(monotonic_seconds() * 1e6);
  }
  bus_.publish(kWorldTruthChannel, truth);
  last_publish_time_ = monotonic_seconds();
}

void SimDaemon::publish_bodies() {
  // Behind LoLA the client, nao-robot, publishes it.
  for (size_t i = 0; i < channels_.size() && !lola_; ++i) {
    bus_.publish(channels_[i].body_state, body_state_of(core_, static_cast<int>(i)));
  }
}

std::string SimDaemon::status_detail(int64_t num_ticks) const {
  if (std::string second = second_process_.describe(); !second.empty()) return second;
  const TickScheduler& scheduler = core_.scheduler();
  if (scheduler.is_paused()) return "paused";
  if (lola_ && !lola_->has_client()) {
    return "waiting for a LoLA client at " + core_.options().lola_socket;
  }
  const int awaited = scheduler.awaited_robot(core_.world().tick());
  if (awaited < 0 || num_ticks != 0) return "";
  return "waiting for " +
         (lola_ ? "the LoLA client" : channels_[static_cast<size_t>(awaited)].joint_command);
}

void SimDaemon::publish_status() {
  const TickStatistics::Report report = statistics_.report(monotonic_seconds());
  real_time_factor_ = report.real_time_factor;
  const TickScheduler& scheduler = core_.scheduler();
  status_.set_state("ready", status_detail(report.num_ticks));
  const World& world = core_.world();
  status_.publish({{"real_time_factor", report.real_time_factor},
                   {"tick_us", report.duration_mean * 1e6},
                   {"tick_delay_p99_ms", report.delay_p99 * 1e3},
                   {"late_ticks", static_cast<double>(scheduler.num_late_ticks())},
                   {"late_commands", static_cast<double>(scheduler.num_late_commands())},
                   {"bad_states", static_cast<double>(world.num_bad_states())},
                   {"dropped_contacts", static_cast<double>(world.num_dropped_contacts())}});
}

}  // namespace nao::sim
