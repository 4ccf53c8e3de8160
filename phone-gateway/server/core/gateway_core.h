#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "messages/command.h"
#include "phone-gateway/server/core/audit_event.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/driving.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/message_bytes.h"
#include "phone-gateway/server/core/request_handler.h"
#include "phone-gateway/server/core/sessions.h"
#include "phone-gateway/server/core/streams.h"

namespace nao::gateway {

/** Identity of the gateway towards clients and on the bus. */
struct GatewayIdentity {
  std::string server_version;
  /** Pairing token that clients of other hosts send in Connect. */
  std::string token;
  /** Prefix of the sources of its commands, unique on the bus: "phone.4711". */
  std::string source;
  /** Number of its first command. Greater than those of every earlier run, since nao-motion
   * executes each number only once. */
  int64_t first_command_id = 1;
};

/** Receivers of the gateway's commands and audit events. */
struct GatewayOutputs {
  std::function<void(const Command&)> send;
  std::function<void(const AuditEvent&)> audit;
};

/** The behaviour of the gateway: joins the objects for sessions, driving, streams and requests.
 *
 * It has no socket, bus, clock, file or log: connections pass in the messages that they received
 * and take out those to be sent; every call has its time, s of a clock that never runs backwards.
 * Nothing that a client sends makes it throw. */
class GatewayCore {
 public:
  GatewayCore(naoremote::RobotDescription robot, const GatewayLimits& limits,
              const GatewayIdentity& identity, GatewayOutputs outputs);
  // The members refer to one another.
  GatewayCore(const GatewayCore&) = delete;
  GatewayCore& operator=(const GatewayCore&) = delete;

  // ---- Connections ----

  /** A connection was accepted.
   * @param wake  Called when next_message() or is_closing() has changed; must not call the core
   *   before it has returned.
   * @return Id of the session, counted up from 1. */
  uint32_t open(Endpoint endpoint, std::function<void()> wake, double now) {
    return sessions_.open(std::move(endpoint), std::move(wake), now);
  }

  /** A whole message was received.
   * @return Time for which the connection must pause reading, s: not 0 if the client exceeds its
   *   request rate or does not read its answers. */
  [[nodiscard]] double receive(uint32_t client, std::string_view message, double now);

  /** Sets the round-trip time that the transport has measured, s. */
  void set_round_trip_time(uint32_t client, double round_trip_time);

  /** The network layer has refused a connection. @param why  For the audit log; a fixed text, so
   *   that repetitions can be recognized. */
  void note_refusal(const std::string& address, const std::string& why);

  /** Closes a connection from the gateway's side, with a notice that says why. */
  void close(uint32_t client, const Reason& reason, double now);

  /** The connection has ended. @param why  For the audit log. */
  void closed(uint32_t client, const std::string& why, double now) {
    sessions_.remove(client, why, now);
  }

  /** Next message for a connection that can take one; null if there is none. */
  [[nodiscard]] MessageBytes next_message(uint32_t client, double now);

  /** True if that message is an image. */
  bool is_image_next(uint32_t client) const;
  /** True from a successful Connect until the client disconnects. */
  bool is_connected(uint32_t client) const;
  /** True if the connection must close as soon as next_message() returns null. */
  bool is_closing(uint32_t client) const;

  // ---- Robot ----

  void set_robot(const RobotSnapshot& robot, double now);
  void set_motion(const MotionSnapshot& motion, double now);
  void add_image(CachedImage image, double now);
  void handle_camera_status(double now) { components_.handle_camera_status(now); }
  void handle_result(const CommandResult& result, double now);

  // ---- Time ----

  /** Repetitions, timeouts and availability. Call it 50 times a second. */
  void step(double now);

  /** The gateway stops: the walk ends, and all connections are closed. */
  void shut_down(double now);

  // ---- State ----

  const Sessions& sessions() const { return sessions_; }
  const ComponentMonitor& components() const { return components_; }
  const Streams& streams() const { return streams_; }
  const Driving& driving() const { return driving_; }

 private:
  void step_components(double now);

  GatewayLimits limits_;
  std::function<void(const AuditEvent&)> audit_;
  Sessions sessions_;
  ComponentMonitor components_;
  Streams streams_;
  ClientCommands commands_;
  Driving driving_;
  RequestHandler requests_;
};

}  // namespace nao::gateway
