#include "phone-gateway/server/bus/gateway_daemon.h"

#include <unistd.h>

#include <algorithm>
#include <naolcm/camera_command_t.hpp>
#include <naolcm/daemon_status_t.hpp>

#include "common/program.h"
#include "common/wall_clock.h"
#include "phone-gateway/server/core/prometheus_text.h"

namespace nao::gateway {
namespace {

constexpr const char* kProgram = "nao-phone-gateway";
constexpr const char* kCameraProgram = "nao-head-camera";

/** A metric that each client has. */
struct ClientMetric {
  const char* name;
  const char* help;
  double (*value)(const ClientSession&);
};

constexpr ClientMetric kClientMetrics[] = {
    {"requests_total", "Requests received from this client",
     [](const ClientSession& session) { return static_cast<double>(session.num_requests); }},
    {"requests_refused_total", "Requests of this client answered with an error",
     [](const ClientSession& session) { return static_cast<double>(session.num_refused); }},
    {"round_trip_seconds", "Round-trip time to this client, as the network stack measures it",
     [](const ClientSession& session) { return session.round_trip_time; }},
    {"messages_sent_total", "Messages sent to this client",
     [](const ClientSession& session) { return static_cast<double>(session.num_sent); }},
    {"frames_skipped_total", "States and images skipped because this client was slow",
     [](const ClientSession& session) {
       return static_cast<double>(session.outbox.num_skipped());
     }},
    {"messages_waiting", "Responses and notices queued for this client",
     [](const ClientSession& session) {
       return static_cast<double>(session.outbox.num_messages());
     }}};

}  // namespace

GatewayDaemon::GatewayDaemon(Bus& bus, const naoremote::RobotDescription& robot,
                             const GatewayLimits& limits, const std::string& token,
                             const std::string& audit_file)
    : bus_(bus),
      channels_(robot.name()),
      source_("phone." + std::to_string(getpid())),
      commands_(bus_, channels_),
      robot_state_reader_(robot),
      status_(bus, kProgram),
      audit_log_(audit_file),
      // The clock makes command ids that no earlier gateway with the same process id has used.
      core_(robot, limits, {version(), token, source_, wall_utime()},
            {[this](const Command& command) { commands_.publish(command); },
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
        // nao-play, nao-speaker and others send results of their own commands on this channel.
        if (message.source.starts_with(source_)) {
          core_.handle_result(read_result(message), monotonic_seconds());
        }
      });
  // The channel carries several sizes: with kLatest one would replace another.
  bus_.subscribe<naolcm::image_t>(channels_.head_camera_image, Bus::Queue::kAll,
                                  [this](const naolcm::image_t& message) {
                                    core_.add_image(read_image(message), monotonic_seconds());
                                  });
  bus_.subscribe<naolcm::daemon_status_t>(kDaemonStatusChannel, Bus::Queue::kAll,
                                          [this](const naolcm::daemon_status_t& message) {
                                            if (message.program == kCameraProgram)
                                              core_.handle_camera_status(monotonic_seconds());
                                          });
}

void GatewayDaemon::step(double now) {
  status_.tick(now);
  core_.step(now);
  std::vector<CameraRequest> requests = core_.streams().camera_requests(now);
  if (requests == last_requests_) return;
  // Sent at each change, so that a client's first image does not wait for the next second.
  last_requests_ = std::move(requests);
  send_camera_requests(last_requests_);
}

void GatewayDaemon::send_camera_requests(const std::vector<CameraRequest>& requests) {
  for (const CameraRequest& request : requests) {
    naolcm::camera_command_t message{};
    message.wall_utime = wall_utime();
    message.source = source_;
    message.camera = request.image.camera;
    message.width = static_cast<int32_t>(request.image.width);
    // camera_command_t allows rates from 1/s on.
    message.rate = std::max(1.0, request.rate);
    message.quality = static_cast<int32_t>(request.image.quality);
    bus_.publish(channels_.head_camera_command, message);
  }
}

void GatewayDaemon::publish_status(double now) {
  const bool has_robot = core_.components().is_available(Component::kRobot);
  const bool has_motion = core_.components().is_available(Component::kMotion);
  status_.set_state("ready", has_robot    ? ""
                             : has_motion ? "waiting for the robot"
                                          : "waiting for " + channels_.motion_state);
  status_.publish(status_metrics());
  send_camera_requests(core_.streams().camera_requests(now));
}

void GatewayDaemon::shut_down(double now) {
  core_.shut_down(now);
  status_.set_state("stopping");
  status_.publish(status_metrics());
}

std::vector<Metric> GatewayDaemon::metrics() const {
  const Sessions& sessions = core_.sessions();
  const ClientCounters counters = sessions.calc_counters();
  double num_waiting = 0;
  for (const auto& [id, session] : sessions.all()) {
    num_waiting += static_cast<double>(session->outbox.num_messages());
  }
  const auto count = [](auto number) { return static_cast<double>(number); };
  return {
      {"clients", count(sessions.num_connected()), "Connected clients"},
      {"connections", count(sessions.all().size()), "Open connections, with or without Connect"},
      {"driver_id", count(core_.driving().driver()), "Number of the client that drives, 0 if none"},
      {"requests_total", count(counters.num_requests), "Requests received"},
      {"requests_refused_total", count(counters.num_refused), "Requests answered with an error"},
      {"messages_sent_total", count(counters.num_sent), "Messages sent to clients"},
      {"frames_skipped_total", count(counters.num_skipped), "States and images skipped"},
      {"messages_waiting", num_waiting, "Responses and notices queued for all clients"}};
}

std::vector<std::pair<std::string, double>> GatewayDaemon::status_metrics() const {
  std::vector<std::pair<std::string, double>> status;
  for (const Metric& metric : metrics()) status.emplace_back(metric.name, metric.value);
  for (const auto& [id, session] : core_.sessions().all()) {
    if (!session->is_connected) continue;
    for (const ClientMetric& metric : kClientMetrics) {
      status.emplace_back("client_" + std::to_string(id) + "_" + metric.name,
                          metric.value(*session));
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
  text.begin("component_available", "1 if this component is available");
  for (const Component component : kComponents) {
    text.add(core_.components().is_available(component) ? 1 : 0,
             std::string("{component=\"") + to_string(component) + "\"}");
  }
  for (const ClientMetric& metric : kClientMetrics) {
    text.begin(std::string("client_") + metric.name, metric.help);
    for (const auto& [id, session] : core_.sessions().all()) {
      if (!session->is_connected) continue;
      text.add(metric.value(*session), "{client=\"" + std::to_string(id) + "\",transport=\"" +
                                           session->endpoint.transport + "\"}");
    }
  }
  return text.text();
}

}  // namespace nao::gateway
