#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "messages/command.h"
#include "phone-gateway/server/core/client_commands.h"
#include "phone-gateway/server/core/component_monitor.h"
#include "phone-gateway/server/core/control_state.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/gateway_reasons.h"
#include "phone-gateway/server/core/play_stream.h"
#include "phone-gateway/server/core/robot_sessions.h"

namespace nao::gateway {

/** Who drives, and what the driver may do: the control lease, the driver's walk and behavior, and
 * the rules that end them. Every change of control is sent to all clients that watch the robot. */
class Driving {
 public:
  /** The other objects must outlive this. */
  Driving(const GatewayLimits& limits, const RobotSessions& sessions,
          const ComponentMonitor& components, ClientCommands& commands, PlayStream& play)
      : limits_(limits),
        components_(components),
        commands_(commands),
        play_(play),
        control_(sessions, limits.lease_idle_timeout) {}

  /** Client that drives; 0 if none. */
  uint32_t driver() const { return control_.driver(); }
  /** Who has control, and the notices of it. */
  const ControlState& control() const { return control_; }

  // Use cases. Each returns why the request is refused, or nothing.

  /** Starts, continues or (all zero) ends the driver's walk. @param is_held  All zero lets it step
   * in place for a while instead. */
  [[nodiscard]] std::optional<Refusal> walk(const ClientSession& session, uint32_t request_id,
                                            const WalkCommand& velocity, bool is_held, double now);
  /** Sends a command of the driver. */
  [[nodiscard]] std::optional<Refusal> command(const ClientSession& session, uint32_t request_id,
                                               decltype(Command::request) request, double now);
  /** Begins or (none) ends a behavior. */
  [[nodiscard]] std::optional<Refusal> play(const ClientSession& session, uint32_t request_id,
                                            const PlayCommand& command, double now);
  /** Stops the robot, for any client. */
  [[nodiscard]] std::optional<Refusal> stop(const ClientSession& session, uint32_t request_id,
                                            double now);
  [[nodiscard]] std::optional<Refusal> take_control(const ClientSession& session, double now);
  /** The client that is refused asks the driver, whom it waits for. */
  void wait_for_control(const ClientSession& session);
  /** @param successor  The waiting client, which gets control; 0: none. */
  void release_control(const ClientSession& session, uint32_t successor, double now);

  /** The operator takes control from any client, or releases it. @param console  For the log. */
  void take_control_as_operator(const ClientSession& console, double now);
  void release_control_as_operator(const ClientSession& console, double now);
  /** The operator gives control to a client, also if another one has it. */
  void assign_control(const ClientSession& session, double now);

  /** Whether a client may do what needs control but no robot. Its lease is refreshed. */
  [[nodiscard]] std::optional<Refusal> check_control(const ClientSession& session, double now);
  /** The same for what moves the robot, too, without being a command of nao-motion. */
  [[nodiscard]] std::optional<Refusal> check_driving(const ClientSession& session, double now);

  /** A command of the gateway itself. It replaces the walk and the motion of a client, whose result
   * nobody receives. */
  void command_by_itself(decltype(Command::request) request, double now);
  /** Every velocity of a walk passes this from now on, each time that it is sent and 50 times a
   * second. */
  void limit_walks(std::function<WalkCommand(const WalkCommand&)> limit) {
    limit_walk_ = std::move(limit);
  }

  // Events.

  /** A client has disconnected: its walk ends, its control is released. */
  void handle_disconnect(const ClientSession& session, double now);
  /** A client watches another robot from now on: the same. */
  void handle_departure(const ClientSession& session, const std::string& next_robot, double now);
  /** A final result of the walk ends it here, too. */
  void handle_result(const CommandResult& result);
  /** nao-motion has become unavailable: walk and behavior are not continued when it is available
   * again. */
  void abandon_motion() {
    abandon_walk();
    play_.abandon();
  }

  /** Ends walk and behavior now, if there are any. */
  void end_motion(double now);

  /** Lets a walk that the driver does not repeat step in place, then ends it. */
  void step(double now);

 private:
  /** Whether a client drives and the robot is available. */
  std::optional<Refusal> check_driver(const ClientSession& session) const;
  void end_walk(double now);
  /** The client no longer waits for control, if it did. */
  void withdraw(const ClientSession& session);
  void step_in_place(double now);
  /** Sends another velocity where the robot has come nearer to what limits it. */
  void follow_limit(double now);
  /** What the driver's walk may be now. */
  WalkCommand calc_allowed_walk() const {
    return limit_walk_ ? limit_walk_(requested_walk_) : requested_walk_;
  }
  /** Another command replaces the walk: nothing more is transmitted. */
  void abandon_walk();
  /** Stops a MoveTo that a client without control has left behind. */
  void stop_move_of(uint32_t client, const ClientSession& sender, double now);

  GatewayLimits limits_;
  const ComponentMonitor& components_;
  ClientCommands& commands_;
  PlayStream& play_;
  ControlState control_;
  /** The driver's last walk, which is repeated, and whether it goes on. */
  Command walk_;
  bool is_walking_ = false;
  /** Its velocity, as it was before the limit. */
  WalkCommand requested_walk_;
  std::function<WalkCommand(const WalkCommand&)> limit_walk_;
  /** Stop was sent during a walk: no new walk until the driver releases the joystick. */
  bool is_walk_blocked_ = false;
  /** s. The walk ends as long after it as nao-motion would end it. */
  double last_walk_turn_ = -1e9;
};

}  // namespace nao::gateway
