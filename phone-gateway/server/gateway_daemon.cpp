#include "server/gateway_daemon.h"

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
#include <sstream>

#include "common/error.h"
#include "common/program.h"
#include "common/wall_clock.h"

namespace nao {
namespace {

constexpr const char* kProgram = "nao-phone-gateway";
constexpr const char* kCameraProgram = "nao-head-camera";

CommandStatus read_status(const std::string& status) {
  if (status == "accepted") return CommandStatus::kAccepted;
  if (status == "refused") return CommandStatus::kRefused;
  if (status == "done") return CommandStatus::kDone;
  if (status == "interrupted") return CommandStatus::kInterrupted;
  if (status == "failed") return CommandStatus::kFailed;
  throw Error("a result of status " + status);
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
    message.wall_utime = wall_utime();
    message.source = numbered_.source;
    message.command_id = numbered_.command_id;
    return message;
  }

  Bus& bus_;
  const RobotChannels& channels_;
  const NumberedCommand& numbered_;
};

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
                                    core_.add_picture(read_image(message), monotonic_seconds());
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
  std::vector<CameraWish> wishes = core_.camera_wishes(now);
  if (wishes == last_wishes_) return;
  // At once, so that a phone's first picture does not wait for the next second.
  last_wishes_ = std::move(wishes);
  send_camera_wishes(last_wishes_);
}

void GatewayDaemon::send_camera_wishes(const std::vector<CameraWish>& wishes) {
  for (const CameraWish& wish : wishes) {
    naolcm::camera_command_t message;
    message.wall_utime = wall_utime();
    message.source = source_;
    message.camera = wish.picture.camera == naoremote::CAMERA_BOTTOM ? "bottom" : "top";
    message.width = static_cast<int32_t>(wish.picture.width);
    message.rate = std::max(1.0, wish.rate);
    message.quality = static_cast<int32_t>(wish.picture.quality);
    bus_.publish(channels_.head_camera_command, message);
  }
}

void GatewayDaemon::publish_status(double now) {
  const bool has_robot = core_.is_available(PartMonitor::Part::kRobot);
  const bool has_motion = core_.is_available(PartMonitor::Part::kMotion);
  status_.set_state("ready", has_robot    ? ""
                             : has_motion ? "waiting for the robot"
                                          : "waiting for " + channels_.motion_state);
  status_.publish(metrics());
  send_camera_wishes(core_.camera_wishes(now));
}

void GatewayDaemon::shut_down(double now) {
  core_.shut_down(now);
  status_.set_state("stopping");
  status_.publish(metrics());
}

std::vector<std::pair<std::string, double>> GatewayDaemon::metrics() const {
  const GatewayCounters counters = core_.counters();
  double num_waiting = 0;
  for (const auto& [id, session] : core_.sessions()) {
    num_waiting += static_cast<double>(session->outbox.num_messages());
  }
  return {{"clients", core_.num_connected()},
          {"connections", static_cast<double>(core_.sessions().size())},
          {"driver_id", core_.driver()},
          {"requests_total", static_cast<double>(counters.num_requests)},
          {"requests_refused_total", static_cast<double>(counters.num_refused)},
          {"messages_sent_total", static_cast<double>(counters.num_sent)},
          {"frames_skipped_total", static_cast<double>(counters.num_skipped)},
          {"messages_waiting", num_waiting}};
}

std::string GatewayDaemon::metrics_text() const {
  std::ostringstream text;
  for (const auto& [name, value] : metrics())
    text << "nao_gateway_" << name << " " << value << "\n";
  for (const auto part :
       {PartMonitor::Part::kMotion, PartMonitor::Part::kRobot, PartMonitor::Part::kCamera}) {
    text << "nao_gateway_part_available{part=\"" << part_name(part) << "\"} "
         << (core_.is_available(part) ? 1 : 0) << "\n";
  }
  for (const auto& [id, session] : core_.sessions()) {
    if (!session->is_connected) continue;
    const std::string labels =
        "{client=\"" + std::to_string(id) + "\",transport=\"" + session->peer.transport + "\"} ";
    text << "nao_gateway_client_requests" << labels << session->num_received << "\n"
         << "nao_gateway_client_round_trip_seconds" << labels << session->round_trip << "\n"
         << "nao_gateway_client_messages_sent" << labels << session->num_sent << "\n"
         << "nao_gateway_client_frames_skipped" << labels << session->outbox.num_skipped() << "\n"
         << "nao_gateway_client_messages_waiting" << labels << session->outbox.num_messages()
         << "\n";
  }
  return text.str();
}

}  // namespace nao
