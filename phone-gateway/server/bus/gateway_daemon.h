#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/status_reporter.h"
#include "phone-gateway/server/bus/audit_log.h"
#include "phone-gateway/server/bus/bus_messages.h"
#include "phone-gateway/server/bus/command_publisher.h"
#include "phone-gateway/server/core/gateway_core.h"
#include "phone-gateway/server/core/metric.h"

namespace nao::gateway {

/** Connects the gateway's core to the bus: passes received messages to the core and publishes its
 * commands.
 *
 * Reads NAO_ROBOT_STATE, NAO_MOTION_STATE, NAO_COMMAND_RESULT, NAO_HEAD_CAMERA_IMAGE and
 * DAEMON_STATUS; writes the NAO_..._COMMAND channels of walk, move-to, posture, joint change,
 * action, stop and head camera, and DAEMON_STATUS. Before the first client drives it publishes no
 * motion command. */
class GatewayDaemon {
 public:
  /** @param robot       Its name is the prefix of the robot's channels.
   * @param token       Pairing token of the clients.
   * @param audit_file  File of the audit log; empty: none.
   * The bus must outlive this. */
  GatewayDaemon(Bus& bus, const naoremote::RobotDescription& robot, const GatewayLimits& limits,
                const std::string& token, const std::string& audit_file = "");

  GatewayCore& core() { return core_; }

  /** To be called 50 times a second. */
  void step(double now);

  /** To be called once a second: publishes DAEMON_STATUS and the image requests. */
  void publish_status(double now);

  /** The gateway stops: the robot's walk ends, and clients are disconnected. */
  void shut_down(double now);

  /** The metrics of DAEMON_STATUS in Prometheus's text format.
   * @param more  Metrics of the network layer. */
  std::string metrics_text(const std::vector<Metric>& more = {}) const;

 private:
  void subscribe();
  void send_camera_requests(const std::vector<CameraRequest>& requests);
  std::vector<Metric> metrics() const;
  std::vector<std::pair<std::string, double>> status_metrics() const;

  Bus& bus_;
  RobotChannels channels_;
  std::string source_;
  CommandPublisher commands_;
  RobotStateReader robot_state_reader_;
  StatusReporter status_;
  AuditLog audit_log_;
  GatewayCore core_;
  std::vector<CameraRequest> last_requests_;
};

}  // namespace nao::gateway
