#include "phone-gateway/server/gateway_daemon.h"

#include <unistd.h>

#include <algorithm>
#include <naolcm/action_command_t.hpp>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/command_result_t.hpp>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/joint_change_command_t.hpp>
#include <naolcm/move_to_command_t.hpp>
#include <naolcm/posture_command_t.hpp>
#include <naolcm/stop_command_t.hpp>
#include <naolcm/walk_command_t.hpp>

#include "common/error.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "phone-gateway/server/prometheus_text.h"

namespace nao {
namespace {

constexpr const char* kProgram = "nao-phone-gateway";
constexpr const char* kCameraProgram = "nao-head-camera";

CommandStatus read_status(int8_t status) {
  switch (status) {
    case naolcm::command_result_t::STATUS_ACCEPTED:
      return CommandStatus::kAccepted;
    case naolcm::command_result_t::STATUS_REFUSED:
      return CommandStatus::kRefused;
    case naolcm::command_result_t::STATUS_DONE:
      return CommandStatus::kDone;
    case naolcm::command_result_t::STATUS_INTERRUPTED:
      return CommandStatus::kInterrupted;
    case naolcm::command_result_t::STATUS_FAILED:
      return CommandStatus::kFailed;
  }
  throw Error("unknown result status " + std::to_string(status));
}

/** Publishes a command as the message of its channel. */
class CommandPublisher {
 public:
  CommandPublisher(Bus& bus, const RobotChannels& channels, const NumberedCommand& command)
      : bus_(bus), channels_(channels), numbered_(command) {}

  void operator()(const WalkVelocity& walk) const {
    auto message = begin<naolcm::walk_command_t>();
    message.vx = walk.vx;
    message.vy = walk.vy;
    message.wz = walk.wz;
    bus_.publish(channels_.walk_command, message);
  }
  void operator()(const RelativeGoal& goal) const {
    auto message = begin<naolcm::move_to_command_t>();
    message.x = goal.x;
    message.y = goal.y;
    message.theta = goal.theta;
    bus_.publish(channels_.move_to_command, message);
  }
  void operator()(const PostureGoal& goal) const {
    auto message = begin<naolcm::posture_command_t>();
    message.posture = goal.posture;
    message.speed = goal.speed;
    bus_.publish(channels_.posture_command, message);
  }
  void operator()(const JointChange& change) const {
    auto message = begin<naolcm::joint_change_command_t>();
    message.num_joints = static_cast<int32_t>(change.joint_names.size());
    message.joint_names = change.joint_names;
    message.joint_position = change.change;
    message.joint_stiffness.assign(change.joint_names.size(),
                                   std::numeric_limits<double>::quiet_NaN());
    message.is_relative = 1;
    message.speed = change.speed;
    message.allow_tipping = change.allow_tipping ? 1 : 0;
    bus_.publish(channels_.joint_change_command, message);
  }
  void operator()(const NamedAction& action) const {
    auto message = begin<naolcm::action_command_t>();
    message.action = action.action;
    message.ball_x = action.ball_x;
    message.ball_y = action.ball_y;
    message.strength = action.strength;
    bus_.publish(channels_.action_command, message);
  }
  void operator()(const StopMotion&) const {
    bus_.publish(channels_.stop_command, begin<naolcm::stop_command_t>());
  }

 private:
  template <class Message>
  Message begin() const {
    Message message;
    message.utime = 0;
    message.wall_utime = wall_utime();
    message.source = numbered_.source;
    message.command_id = numbered_.command_id;
    return message;
  }

  Bus& bus_;
  const RobotChannels& channels_;
  const NumberedCommand& numbered_;
};

/** A figure of each client. */
struct ClientFigure {
  const char* name;
  const char* help;
  double (*value)(const PhoneSession&);
};

constexpr ClientFigure kClientFigures[] = {
    {"requests_total", "Requests received from this client",
     [](const PhoneSession& session) { return static_cast<double>(session.num_received); }},
    {"requests_refused_total", "Requests of this client answered with an error",
     [](const PhoneSession& session) { return static_cast<double>(session.num_refused); }},
    {"round_trip_seconds", "Time to this client and back, as the network stack measures it",
     [](const PhoneSession& session) { return session.round_trip; }},
    {"messages_sent_total", "Messages sent to this client",
     [](const PhoneSession& session) { return static_cast<double>(session.num_sent); }},
    {"frames_skipped_total", "States and images dropped because this client was slow",
     [](const PhoneSession& session) { return static_cast<double>(session.outbox.num_skipped()); }},
    {"messages_waiting", "Answers and notices in this client's queue",
     [](const PhoneSession& session) {
       return static_cast<double>(session.outbox.num_messages());
     }}};

std::string process_source() {
  return "phone." + std::to_string(getpid());
}

}  // namespace

GatewayDaemon::GatewayDaemon(Bus& bus, const std::string& robot_name, PhoneRobot robot,
                             const GatewayLimits& limits, const std::string& token,
                             const std::string& audit_file)
    : bus_(bus),
      channels_(robot_name),
      source_(process_source()),
      robot_state_reader_(robot.description),
      status_(bus, kProgram),
      audit_log_(audit_file),
      core_(std::move(robot), limits, {version(), token, source_, wall_utime()},
            {[this](const NumberedCommand& command) { send(command); },
             [this](const AuditEvent& event) {
               audit_log_.write(event, monotonic_seconds(), wall_utime());
             }}) {
  subscribe();
}

void GatewayDaemon::subscribe() {
  bus_.subscribe<naolcm::robot_state_t>(
      channels_.robot_state, Bus::Queue::kLatest, [this](const naolcm::robot_state_t& message) {
        core_.set_robot(robot_state_reader_.read(message), monotonic_seconds());
      });
  bus_.subscribe<naolcm::motion_state_t>(
      channels_.motion_state, Bus::Queue::kLatest, [this](const naolcm::motion_state_t& message) {
        core_.set_motion(read_motion_state(message), monotonic_seconds());
      });
  bus_.subscribe<naolcm::command_result_t>(
      channels_.command_result, Bus::Queue::kAll, [this](const naolcm::command_result_t& message) {
        core_.add_result(
            {message.source, message.command_id, read_status(message.status), message.reason},
            monotonic_seconds());
      });
  // Several sizes share the channel: the latest of one must not push out another.
  bus_.subscribe<naolcm::image_t>(channels_.head_camera_image, Bus::Queue::kAll,
                                  [this](const naolcm::image_t& message) {
                                    core_.add_image(read_image(message), monotonic_seconds());
                                  });
  bus_.subscribe<naolcm::daemon_status_t>(kDaemonStatusChannel, Bus::Queue::kAll,
                                          [this](const naolcm::daemon_status_t& message) {
                                            if (message.program == kCameraProgram)
                                              core_.heard_camera_status(monotonic_seconds());
                                          });
}

void GatewayDaemon::send(const NumberedCommand& command) {
  std::visit(CommandPublisher(bus_, channels_, command), command.command);
}

void GatewayDaemon::step(double now) {
  status_.tick(now);
  core_.step(now);
  std::vector<CameraRequest> wishes = core_.camera_requests(now);
  if (wishes == last_wishes_) return;
  // At once, so that a phone's first image does not wait for the next second.
  last_wishes_ = std::move(wishes);
  send_camera_requests(last_wishes_);
}

void GatewayDaemon::send_camera_requests(const std::vector<CameraRequest>& wishes) {
  for (const CameraRequest& wish : wishes) {
    naolcm::camera_command_t message;
    message.utime = 0;
    message.wall_utime = wall_utime();
    message.source = source_;
    message.camera = wish.image.camera;
    message.width = static_cast<int32_t>(wish.image.width);
    message.rate = std::max(1.0, wish.rate);
    message.quality = static_cast<int32_t>(wish.image.quality);
    bus_.publish(channels_.head_camera_command, message);
  }
}

void GatewayDaemon::publish_status(double now) {
  const bool has_robot = core_.is_available(PartMonitor::Part::kRobot);
  const bool has_motion = core_.is_available(PartMonitor::Part::kMotion);
  status_.set_state("ready", has_robot    ? ""
                             : has_motion ? "waiting for the robot"
                                          : "waiting for " + channels_.motion_state);
  status_.publish(status_metrics());
  send_camera_requests(core_.camera_requests(now));
}

void GatewayDaemon::shut_down(double now) {
  core_.shut_down(now);
  status_.set_state("stopping");
  status_.publish(status_metrics());
}

std::vector<Metric> GatewayDaemon::metrics() const {
  const GatewayCounters counters = core_.counters();
  double num_waiting = 0;
  for (const auto& [id, session] : core_.sessions()) {
    num_waiting += static_cast<double>(session->outbox.num_messages());
  }
  const auto count = [](auto number) { return static_cast<double>(number); };
  return {
      {"clients", count(core_.num_connected()), "Clients that are connected"},
      {"connections", count(core_.sessions().size()), "Connections, clients or not yet"},
      {"driver_id", count(core_.driver()), "Number of the client that drives, 0 if none"},
      {"requests_total", count(counters.num_requests), "Requests received"},
      {"requests_refused_total", count(counters.num_refused), "Requests answered with an error"},
      {"messages_sent_total", count(counters.num_sent), "Messages sent to clients"},
      {"frames_skipped_total", count(counters.num_skipped), "States and images dropped"},
      {"messages_waiting", num_waiting, "Answers and notices in all queues"}};
}

std::vector<std::pair<std::string, double>> GatewayDaemon::status_metrics() const {
  std::vector<std::pair<std::string, double>> status;
  for (const Metric& metric : metrics()) status.emplace_back(metric.name, metric.value);
  for (const auto& [id, session] : core_.sessions()) {
    if (!session->is_connected) continue;
    for (const ClientFigure& figure : kClientFigures) {
      status.emplace_back("client_" + std::to_string(id) + "_" + figure.name,
                          figure.value(*session));
    }
  }
  return status;
}

std::string GatewayDaemon::metrics_text(const std::vector<Metric>& more) const {
  PrometheusText text;
  std::vector<Metric> all = metrics();
  all.insert(all.end(), more.begin(), more.end());
  for (const Metric& metric : all) {
    text.begin(metric.name, metric.help);
    text.add(metric.value);
  }
  text.begin("part_available", "1 if this part of the robot answers");
  for (const auto part :
       {PartMonitor::Part::kMotion, PartMonitor::Part::kRobot, PartMonitor::Part::kCamera}) {
    text.add(core_.is_available(part) ? 1 : 0, std::string("{part=\"") + part_name(part) + "\"}");
  }
  for (const ClientFigure& figure : kClientFigures) {
    text.begin(std::string("client_") + figure.name, figure.help);
    for (const auto& [id, session] : core_.sessions()) {
      if (!session->is_connected) continue;
      text.add(figure.value(*session), "{client=\"" + std::to_string(id) + "\",transport=\"" +
                                           session->peer.transport + "\"}");
    }
  }
  return text.text();
}

}  // namespace nao
