#include "phone-gateway/server/bus/gateway_daemon.h"

#include <unistd.h>

#include <naolcm/daemon_status_t.hpp>
#include <naolcm/match_state_t.hpp>

#include "common/channels.h"
#include "common/program.h"
#include "common/wall_clock.h"
#include "phone-gateway/server/core/prometheus_text.h"

namespace nao::gateway {
namespace {

constexpr const char* kProgram = "nao-phone-gateway";
constexpr const char* kCameraProgram = "nao-head-camera";
constexpr const char* kSimulatorProgram = "nao-sim";

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

std::vector<std::unique_ptr<RobotLink>> make_links(
    Bus& bus, const std::vector<naoremote::RobotDescription>& robots, const std::string& source) {
  std::vector<std::unique_ptr<RobotLink>> links;
  for (const auto& robot : robots) links.push_back(std::make_unique<RobotLink>(bus, robot, source));
  return links;
}

}  // namespace

GatewayDaemon::GatewayDaemon(Bus& bus, const std::vector<naoremote::RobotDescription>& robots,
                             const GatewayLimits& limits, const std::string& token,
                             const std::string& audit_file,
                             std::optional<ExhibitionSetup> exhibition)
    : bus_(bus),
      source_("phone." + std::to_string(getpid())),
      status_(bus, kProgram),
      audit_log_(audit_file),
      links_(make_links(bus, robots, source_)),
      // The clock makes command ids that no earlier gateway with the same process id has used.
      core_(
          make_setups(), limits, {version(), token, source_, wall_utime()},
          [this](const AuditEvent& event) {
            audit_log_.write(event, monotonic_seconds(), wall_utime());
          },
          std::move(exhibition)) {
  for (size_t i = 0; i < links_.size(); ++i) {
    links_[i]->subscribe(core_.robot(i), [this, i](CachedImage image) {
      core_.add_image(i, std::move(image), monotonic_seconds());
    });
  }
  subscribe();
}

std::vector<RobotSetup> GatewayDaemon::make_setups() {
  std::vector<RobotSetup> setups;
  for (const auto& link : links_) setups.push_back(link->setup());
  return setups;
}

void GatewayDaemon::subscribe() {
  bus_.subscribe<naolcm::daemon_status_t>(
      kDaemonStatusChannel, Bus::Queue::kAll, [this](const auto& message) {
        const double now = monotonic_seconds();
        for (size_t i = 0; i < core_.num_robots(); ++i) {
          ComponentMonitor& components = core_.robot(i).components();
          if (message.program == kCameraProgram && message.robot == core_.robot(i).name()) {
            components.handle_camera_status(now);
          }
          if (message.program == kSimulatorProgram) components.handle_simulator_status(now);
        }
      });
  bus_.subscribe<naolcm::match_state_t>(kMatchStateChannel, Bus::Queue::kLatest,
                                        [this](const auto& message) {
                                          const MatchState state = to_match_state(message);
                                          core_.set_players(read_players(state));
                                          core_.set_match(read_match(state), monotonic_seconds());
                                        });
}

void GatewayDaemon::step(double now) {
  status_.tick(now);
  core_.step(now);
  // Sent at each change, so that a client's first image does not wait for the next second.
  for (size_t i = 0; i < links_.size(); ++i) {
    links_[i]->send_camera_requests(core_.camera_requests(i, now), false);
  }
}

std::string GatewayDaemon::describe_state() const {
  for (size_t i = 0; i < links_.size(); ++i) {
    const GatewayRobot& robot = core_.robot(i);
    if (robot.components().is_available(Component::kRobot)) continue;
    return robot.components().is_available(Component::kMotion)
               ? "waiting for the robot" + (links_.size() > 1 ? " " + robot.name() : "")
               : "waiting for " + links_[i]->motion_state_channel();
  }
  return "";
}

void GatewayDaemon::publish_status(double now) {
  status_.set_state("ready", describe_state());
  status_.publish(status_metrics());
  for (size_t i = 0; i < links_.size(); ++i) {
    links_[i]->send_camera_requests(core_.camera_requests(i, now), true);
  }
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
      {"driver_id", count(core_.robot().driving().driver()),
       "Number of the client that drives the first robot, 0 if none"},
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

std::string GatewayDaemon::robot_label(size_t index) const {
  return core_.num_robots() > 1 ? ",robot=\"" + core_.robot(index).name() + "\"" : "";
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
  for (size_t i = 0; i < core_.num_robots(); ++i) {
    for (const Component component : kComponents) {
      text.add(core_.robot(i).components().is_available(component) ? 1 : 0,
               std::string("{component=\"") + to_string(component) + "\"" + robot_label(i) + "}");
    }
  }
  if (core_.num_robots() > 1) {
    text.begin("robot_driver_id", "Number of the client that drives this robot, 0 if none");
    for (size_t i = 0; i < core_.num_robots(); ++i) {
      text.add(core_.robot(i).driving().driver(), "{robot=\"" + core_.robot(i).name() + "\"}");
    }
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
