#pragma once

#include <string>
#include <vector>

#include "common/bus.h"
#include "common/channels.h"
#include "common/status_reporter.h"
#include "phone-gateway/server/audit_log.h"
#include "phone-gateway/server/bus_messages.h"
#include "phone-gateway/server/gateway_core.h"
#include "phone-gateway/server/metric.h"
#include "robot_model/robot_model.h"

namespace nao {

/** The core on the bus: hands it what the robot's programs say, and sends them what it decides.
 *
 * Reads NAO_ROBOT_STATE, NAO_MOTION_STATE, NAO_COMMAND_RESULT, NAO_HEAD_CAMERA_IMAGE,
 * DAEMON_STATUS; writes the NAO_..._COMMAND channels of walk, move-to, posture, joint change,
 * action, stop and head camera, and DAEMON_STATUS. Before the first phone drives it sends no
 * command. */
class GatewayDaemon {
 public:
  /** @param robot_name  Prefix of the robot's channels.
   * @param token  What phones must say.
   * @param audit_file  Where the audit log is kept beside the log; empty: nowhere.
   * The bus must outlive this. */
  GatewayDaemon(Bus& bus, const std::string& robot_name, PhoneRobot robot,
                const GatewayLimits& limits, const std::string& token,
                const std::string& audit_file = "");

  GatewayCore& core() { return core_; }

  /** To be called 50 times a second. */
  void step(double now);

  /** To be called once a second: says how the gateway does, and that somebody watches the camera.
   */
  void publish_status(double now);

  /** The gateway ends: the robot's walk does, too. */
  void shut_down(double now);

  /** The same figures as in DAEMON_STATUS, as Prometheus reads them.
   * @param more  Figures of others that belong to the gateway. */
  std::string metrics_text(const std::vector<Metric>& more = {}) const;

 private:
  void subscribe();
  void send(const NumberedCommand& command);
  void send_camera_requests(const std::vector<CameraRequest>& wishes);
  std::vector<Metric> metrics() const;
  std::vector<std::pair<std::string, double>> status_metrics() const;

  Bus& bus_;
  RobotChannels channels_;
  std::string source_;
  RobotStateReader robot_state_reader_;
  StatusReporter status_;
  AuditLog audit_log_;
  GatewayCore core_;
  std::vector<CameraRequest> last_wishes_;
};

}  // namespace nao
