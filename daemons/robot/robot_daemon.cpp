#include "daemons/robot/robot_daemon.h"

#include <sys/timerfd.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "common/error.h"
#include "common/logger.h"
#include "common/wall_clock.h"
#include "messages/light_command.h"
#include "messages/result_message.h"

namespace nao::robot {
namespace {

/** Time for the answer to a frame, s: Nao Devils answer after 8 ms at the latest. */
constexpr double kAnswerTime = 0.008;
/** In lock-step a sensor state that is not answered is sent again after this time, s: as nao-sim
 * does. */
constexpr double kRepeatTime = 0.1;
/** Time between attempts to connect, and after the end of a connection, s: B-Human waits 100 ms;
 * otherwise a broken message may come first. */
constexpr double kReconnectTime = 0.1;
/** Frames between two body states: 10 Hz. */
constexpr int64_t kBodyStateFrames = 8;
/** Time without a report of the gateway after which a driver counts as gone, s; a running gateway
 * sends its status every second. */
constexpr double kDriverTime = 3;

}  // namespace

RobotDaemon::RobotDaemon(Bus& bus, EventLoop& loop, const RobotModel& model,
                         const RobotOptions& options, const std::string& robot)
    : bus_(bus),
      loop_(loop),
      model_(model),
      options_(options),
      channels_(robot),
      status_(bus, "nao-robot", robot),
      map_(LolaMap::load(model)),
      messages_(model, map_) {
  deadline_ = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
  if (deadline_ < 0) throw Error(std::string("cannot make a timer: ") + std::strerror(errno));
  subscribe();
  loop_.on_readable(bus_.descriptor(), [this] { bus_.handle(); });
  loop_.on_readable(deadline_, [this] {
    uint64_t expirations = 0;
    if (read(deadline_, &expirations, sizeof expirations) > 0) handle_deadline();
  });
  loop_.every(kReconnectTime, [this] { connect(); });
  loop_.every_aligned(1.0, [this] { publish_status(); });
  if (options_.heartbeat >= 0) {
    loop_.every(kHeartbeatPeriod, [this] {
      // A full pipe means that the watchdog does not read, which this program cannot change.
      [[maybe_unused]] const ssize_t ignored = write(options_.heartbeat, "", 1);
    });
  }
  connect();
  publish_status();
}

RobotDaemon::~RobotDaemon() {
  if (session_) loop_.forget(session_->connection.descriptor());
  loop_.forget(deadline_);
  close(deadline_);
}

void RobotDaemon::subscribe() {
  // The latest command only: an older one answers an earlier frame.
  bus_.subscribe<naolcm::joint_command_t>(
      channels_.joint_command, Bus::Queue::kLatest,
      [this](const auto& message) { take_joint_command(message); });
  bus_.subscribe<naolcm::light_command_t>(
      channels_.light_command, Bus::Queue::kAll,
      [this](const auto& message) { take_light_command(message); });
  bus_.subscribe<naolcm::daemon_status_t>(kDaemonStatusChannel, Bus::Queue::kAll,
                                          [this](const auto& message) { take_status(message); });
}

void RobotDaemon::connect() {
  const double now = monotonic_seconds();
  // One attempt every 100 ms; not while the program ends.
  if (session_ || is_ending_ || now - disconnect_time_ < kReconnectTime) return;
  auto socket = UnixSocket::connect(options_.lola_socket);
  if (!socket) return;
  session_.emplace(std::move(*socket), model_, map_, options_);
  loop_.on_readable(session_->connection.descriptor(), [this] { read_frames(); });
  logger::info("connected to LoLA at {}", options_.lola_socket);
}

void RobotDaemon::disconnect() {
  logger::warn("LoLA at {}: {}", options_.lola_socket, session_->connection.end());
  loop_.forget(session_->connection.descriptor());
  session_.reset();
  disconnect_time_ = monotonic_seconds();
  set_deadline(0);
  if (is_ending_) loop_.stop("the end of the LoLA connection");
}

void RobotDaemon::read_frames() {
  session_->connection.receive();
  while (session_ && session_->connection.next(state_)) {
    // Queued frames are answered one by one, each with the latest command.
    if (session_->is_pending) finish_frame(nullptr);
    begin_frame();
  }
  // The connection ends after all complete messages were read.
  if (session_ && !session_->connection.end().empty()) disconnect();
}

void RobotDaemon::begin_frame() {
  Session& session = *session_;
  session.frame_time = monotonic_seconds();
  session.stamp = session.clock.take(session.frame_time);
  // LoLA frames that were lost lengthen the step.
  session.core.take_frame(state_, session.stamp.num_periods);
  if (session.stamp.num_periods == 0) session.command = session.core.targets();
  ++num_frames_;
  bus_.publish(channels_.sensor_state, messages_.sensor_state(session.core, session.stamp.utime));
  if (num_frames_ % kBodyStateFrames == 1) {
    bus_.publish(channels_.body_state, messages_.body_state(session.core, session.stamp.utime));
  }
  session.is_pending = true;
  const double now = monotonic_seconds();
  // The latency that this program adds, without the controller's own time.
  session.publish_time = now - session.frame_time;
  status_.tick(now);
  // Lock-step waits for the answer; a real robot gets one at kAnswerTime in any case, from the last
  // command. Without a controller there is nothing to wait for.
  if (options_.lock_step && !is_ending_) {
    set_deadline(kRepeatTime);
  } else if (session.core.safety().has_controller()) {
    set_deadline(kAnswerTime - session.publish_time);
  } else {
    finish_frame(nullptr);
  }
}

// Sends the answer to the frame; LoLA expects one for each frame. nullptr: no command in time, the
// targets are held.
void RobotDaemon::finish_frame(const Targets* command) {
  Session& session = *session_;
  session.is_pending = false;
  if (std::exchange(session.has_late_command, false)) command = &session.command;
  const bool has_driver = monotonic_seconds() - driver_time_ < kDriverTime;
  const LolaCommand& answer = session.core.step({command, has_driver, is_ending_});
  std::array<uint8_t, kLolaCommandBytes> bytes;
  session.connection.send(std::span(bytes).first(encode(answer, bytes)));
  log_phase();
  if (session.core.safety().phase() == Phase::kEnded) {
    is_ending_ = true;
    loop_.stop(to_string(session.core.safety().cause()));
  }
}

void RobotDaemon::take_joint_command(const naolcm::joint_command_t& message) {
  const double start = monotonic_seconds();
  if (!session_) return;
  Session& session = *session_;
  // Commands for another count of ticks are from before its restart. The count restarts when a
  // robot begins to be driven.
  if (message.tick > session.core.tick()) return;
  merge(message, model_.motor_names(), session.command);
  if (!session.is_pending || message.tick != session.core.tick()) {
    // The command is late: it is used in the next frame.
    session.has_late_command = true;
    return;
  }
  finish_frame(&session.command);
  latencies_.note(session.publish_time + monotonic_seconds() - start);
}

void RobotDaemon::take_light_command(const naolcm::light_command_t& message) {
  const LightCommand command = to_light_command(message);
  CommandResult result{message.source, message.command_id, CommandKind::kLight,
                       ResultStatus::kRefused, Reason("no-robot")};
  if (session_) {
    Lights& lights = session_->core.lights();
    if (const auto fault = check(command, lights.names())) {
      result.reason = *fault;
    } else {
      lights.set(command);
      result.reason = {};
      result.status = ResultStatus::kDone;
    }
  }
  publish(result);
}

void RobotDaemon::publish(const CommandResult& result) {
  bus_.publish(channels_.command_result, to_message(result, session_ ? session_->stamp.utime : 0));
}

// The eyes show whether a client drives: from the gateway's status.
void RobotDaemon::take_status(const naolcm::daemon_status_t& message) {
  if (message.program != "nao-phone-gateway") return;
  for (int i = 0; i < message.num_metrics; ++i) {
    const auto index = static_cast<size_t>(i);
    if (message.metric_names[index] != "driver_id") continue;
    driver_time_ = message.metric_values[index] > 0 ? monotonic_seconds() : -1e9;
  }
}

void RobotDaemon::handle_deadline() {
  if (!session_ || !session_->is_pending) return;
  if (!options_.lock_step || is_ending_) {
    // The command may lie in the queue already.
    bus_.handle();
    if (session_ && session_->is_pending) finish_frame(nullptr);
    return;
  }
  bus_.publish(channels_.sensor_state,
               messages_.sensor_state(session_->core, session_->stamp.utime));
  set_deadline(kRepeatTime);
}

void RobotDaemon::set_deadline(double delay) {
  itimerspec timing{};
  // 0 would stop the timer.
  timing.it_value.tv_nsec = std::max(1000L, std::lround(delay * 1e9));
  timerfd_settime(deadline_, 0, &timing, nullptr);
}

// The end itself comes from Safety, in frames to come; has_ended() tells.
void RobotDaemon::begin_end() {
  is_ending_ = true;
  status_.set_state("stopping");
  if (!session_) {
    loop_.stop("no LoLA connection");
  } else if (session_->is_pending) {
    finish_frame(nullptr);
  }
}

bool RobotDaemon::has_ended() const {
  return is_ending_ && (!session_ || session_->core.safety().phase() == Phase::kEnded);
}

void RobotDaemon::log_phase() {
  const Safety& safety = session_->core.safety();
  if (safety.phase() == session_->logged_phase) return;
  session_->logged_phase = safety.phase();
  const bool is_leaving = safety.phase() == Phase::kSitting || safety.phase() == Phase::kLimp;
  const std::string cause = is_leaving ? to_string(safety.cause()) : "";
  logger::info("the robot is {}{}{}", to_string(safety.phase()), cause.empty() ? "" : ": ", cause);
  publish_status();
}

void RobotDaemon::publish_status() {
  if (!is_ending_) {
    if (!session_) {
      status_.set_state("waiting", "waiting for LoLA at " + options_.lola_socket);
    } else {
      const Safety& safety = session_->core.safety();
      std::string detail = to_string(safety.phase());
      if (safety.phase() == Phase::kLimp && safety.cause() != Cause::kNone) {
        detail += ": " + to_string(safety.cause());
      }
      // A robot that starts itself takes commands soon; another one waits for its button.
      const bool is_starting = options_.starts_itself && safety.phase() != Phase::kDriven;
      status_.set_state(is_starting ? "waiting" : "ready", detail);
    }
  }
  status_.publish({{"frames", static_cast<double>(num_frames_)},
                   {"added_latency_p99_us", latencies_.p99() * 1e6}});
}

}  // namespace nao::robot
