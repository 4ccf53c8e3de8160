#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/bus.h"
#include "common/status_reporter.h"
#include "phone-gateway/server/bus/audit_log.h"
#include "phone-gateway/server/bus/robot_link.h"
#include "phone-gateway/server/core/gateway_core.h"
#include "phone-gateway/server/core/metric.h"

namespace nao::gateway {

/** Connects the gateway's core to the bus: passes received messages to the core and publishes its
 * commands.
 *
 * Reads and writes the channels of every robot (see RobotLink), reads MATCH_STATE and
 * DAEMON_STATUS, and writes DAEMON_STATUS. Before the first client drives it publishes no motion
 * command. */
class GatewayDaemon {
 public:
  /** @param robots      At least one. Their names are the prefixes of their channels.
   * @param token       Pairing token of the clients.
   * @param audit_file  File of the audit log; empty: none.
   * @param exhibition  As of GatewayCore.
   * The bus must outlive this. */
  GatewayDaemon(Bus& bus, const std::vector<naoremote::RobotDescription>& robots,
                const GatewayLimits& limits, const std::string& token,
                const std::string& audit_file = "",
                std::optional<ExhibitionSetup> exhibition = std::nullopt);

  GatewayCore& core() { return core_; }

  /** To be called 50 times a second. */
  void step(double now);

  /** To be called once a second: publishes DAEMON_STATUS and the image requests. */
  void publish_status(double now);

  /** The gateway stops: the robots' walks end, and clients are disconnected. */
  void shut_down(double now);

  /** The metrics of DAEMON_STATUS in Prometheus's text format.
   * @param more  Metrics of the network layer. */
  std::string metrics_text(const std::vector<Metric>& more = {}) const;

 private:
  void subscribe();
  std::vector<RobotSetup> make_setups();
  std::string describe_state() const;
  /** Label of a metric; empty if there is only one robot. */
  std::string robot_label(size_t index) const;
  std::vector<Metric> metrics() const;
  std::vector<std::pair<std::string, double>> status_metrics() const;

  Bus& bus_;
  std::string source_;
  StatusReporter status_;
  AuditLog audit_log_;
  std::vector<std::unique_ptr<RobotLink>> links_;
  GatewayCore core_;
};

}  // namespace nao::gateway
