#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "messages/command.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/driving_lease.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/sessions.h"
#include "phone-gateway/server/core/walk_stream.h"

namespace nao::gateway {

/** Who drives, and what the driver may do: the control lease, the driver's walk, and the rules that
 * end it. Every change of control is sent to all clients as a notice. */
class Driving {
 public:
  /** The other objects must outlive this. */
  Driving(const GatewayLimits& limits, Sessions& sessions, const ComponentMonitor& components,
          ClientCommands& commands)
      : limits_(limits),
        sessions_(sessions),
        components_(components),
        commands_(commands),
        lease_(limits.lease_idle_timeout),
        walk_(limits) {}

  /** Client that drives; 0 if none. */
  uint32_t driver() const { return lease_.driver(); }

  /** Who has control, as one client sees it. */
  naoremote::Control describe_control(const ClientSession& session) const;

  // Use cases. Each returns why the request is refused, or nothing.

  /** Starts, continues or (all zero) ends the driver's walk. */
  [[nodiscard]] std::optional<Refusal> walk(const ClientSession& session, uint32_t request_id,
                                            const WalkCommand& velocity, double now);
  /** Sends a command of the driver. */
  [[nodiscard]] std::optional<Refusal> command(const ClientSession& session, uint32_t request_id,
                                               decltype(Command::request) request, double now);
  /** Stops the robot, for any client. */
  [[nodiscard]] std::optional<Refusal> stop(const ClientSession& session, uint32_t request_id,
                                            double now);
  [[nodiscard]] std::optional<Refusal> take_control(const ClientSession& session, double now);
  void release_control(const ClientSession& session, double now);

  /** The operator takes control from any client, or releases it. @param console  For the log. */
  void take_control_as_operator(const ClientSession& console, double now);
  void release_control_as_operator(const ClientSession& console);

  // Events.

  /** A client has disconnected: its walk ends, its control is released. */
  void handle_disconnect(const ClientSession& session, double now);
  /** A final result of the walk ends it here, too. */
  void handle_result(const CommandResult& result);
  /** nao-motion has become unavailable: the walk is not continued when it is available again. */
  void abandon_walk() { walk_.abandon(); }

  /** Ends the walk now, if there is one. */
  void end_walk(double now);

  /** Transmits the walk command that is due. */
  void step(double now);

 private:
  /** Whether a client drives and the robot is available. */
  std::optional<Refusal> check_driver(const ClientSession& session) const;
  Refusal refuse_control() const;
  /** Stops a MoveTo that a client without control has left behind. */
  void stop_move_of(uint32_t client, const ClientSession& sender, double now);
  std::string driver_name() const;
  void send_control_changed(const Reason& reason) const;

  GatewayLimits limits_;
  Sessions& sessions_;
  const ComponentMonitor& components_;
  ClientCommands& commands_;
  DrivingLease lease_;
  WalkStream walk_;
  /** Stop was sent during a walk: no new walk until the driver releases the joystick. */
  bool is_walk_blocked_ = false;
  /** s. */
  double last_walk_turn_ = -1e9;
};

}  // namespace nao::gateway
