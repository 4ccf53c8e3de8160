#include "phone-gateway/server/core/driving.h"

#include <utility>

#include "phone-gateway/server/core/client_name.h"

namespace nao::gateway {

// ---- Control ------------------------------------------------------------------------------------

std::string Driving::driver_name() const {
  if (lease_.driver() == kOperatorId) return kOperatorName;
  const ClientSession* session = sessions_.find(lease_.driver());
  return session == nullptr ? "" : session->name;
}

naoremote::Control Driving::describe_control(const ClientSession& session) const {
  naoremote::Control control;
  control.set_driver_id(lease_.driver());
  control.set_driver_name(driver_name());
  control.set_is_mine(lease_.driver() == session.id);
  return control;
}

void Driving::send_control_changed(const Reason& reason) const {
  for (const auto& [id, session] : sessions_.all()) {
    if (!session->is_connected) continue;
    naoremote::ServerMessage message;
    naoremote::Notice& notice = *message.mutable_notice();
    notice.set_kind(naoremote::Notice::CONTROL_CHANGED);
    write_reason(reason, notice);
    *notice.mutable_control() = describe_control(*session);
    session->send(message);
  }
}

Refusal Driving::refuse_control() const {
  return {naoremote::CONTROL_TAKEN, gateway_reason("control-taken", {driver_name()})};
}

std::optional<Refusal> Driving::take_control(const ClientSession& session, double now) {
  const uint32_t previous = lease_.driver();
  if (!lease_.take(session.id, now)) return refuse_control();
  if (previous == session.id) return std::nullopt;
  end_walk(now);
  is_walk_blocked_ = false;
  sessions_.audit("drives", session, "");
  send_control_changed(gateway_reason("driver-changed", {session.name}));
  return std::nullopt;
}

void Driving::release_control(const ClientSession& session, double now) {
  if (lease_.driver() != session.id) return;
  end_walk(now);
  lease_.release(session.id);
  sessions_.audit("released", session, "");
  send_control_changed(gateway_reason("control-released", {session.name}));
}

void Driving::take_control_as_operator(const ClientSession& console, double now) {
  if (lease_.driver() == kOperatorId) return;
  if (lease_.driver() != 0) stop_move_of(lease_.driver(), console, now);
  end_walk(now);
  lease_.take(kOperatorId, now);
  sessions_.audit("operator", console, "takes control");
  send_control_changed(gateway_reason("driver-changed", {kOperatorName}));
}

void Driving::release_control_as_operator(const ClientSession& console) {
  if (!lease_.release(kOperatorId)) return;
  sessions_.audit("operator", console, "releases control");
  send_control_changed(gateway_reason("control-released", {kOperatorName}));
}

void Driving::handle_disconnect(const ClientSession& session, double now) {
  stop_move_of(session.id, session, now);
  if (lease_.driver() != session.id) return;
  end_walk(now);
  lease_.release(session.id);
  send_control_changed(gateway_reason("driver-disconnected", {session.name}));
}

// ---- Commands -----------------------------------------------------------------------------------

std::optional<Refusal> Driving::check_driver(const ClientSession& session) const {
  if (lease_.driver() == 0) return Refusal{naoremote::NO_CONTROL, gateway_reason("no-driver")};
  if (lease_.driver() != session.id) return refuse_control();
  if (components_.is_available(Component::kRobot)) return std::nullopt;
  const bool has_motion = components_.is_available(Component::kMotion);
  return Refusal{naoremote::ROBOT_UNAVAILABLE,
                 availability_reason(has_motion ? Component::kRobot : Component::kMotion, false)};
}

std::optional<Refusal> Driving::walk(const ClientSession& session, uint32_t request_id,
                                     const WalkCommand& velocity, double now) {
  if (auto refusal = check_driver(session)) return refusal;
  lease_.refresh(now);
  const bool was_released = now - last_walk_turn_ >= limits_.walk_timeout;
  last_walk_turn_ = now;
  if (velocity.vx == 0 && velocity.vy == 0 && velocity.wz == 0) {
    is_walk_blocked_ = false;
    end_walk(now);
    return std::nullopt;
  }
  // After a Stop a held joystick must not start the walk again. The driver has released it after a
  // zero velocity, or after as long a pause as ends a walk.
  if (was_released) is_walk_blocked_ = false;
  if (is_walk_blocked_) return Refusal{naoremote::STOPPED, gateway_reason("walk-stopped")};
  if (!walk_.is_walking()) {
    const Command begun = commands_.make(session.id, velocity);
    walk_.begin(begun.source, begun.id);
    commands_.track(session.id, request_id, begun, now);
  }
  commands_.transmit(walk_.update(velocity, now));
  return std::nullopt;
}

std::optional<Refusal> Driving::command(const ClientSession& session, uint32_t request_id,
                                        decltype(Command::request) request, double now) {
  if (auto refusal = check_driver(session)) return refusal;
  lease_.refresh(now);
  // Head and arms may move during a walk; any other command replaces it. The walk is abandoned, not
  // ended: a zero velocity after the new command would end that one.
  if (!std::holds_alternative<JointChangeCommand>(request)) walk_.abandon();
  commands_.send(session.id, request_id, commands_.make(session.id, std::move(request)), now);
  return std::nullopt;
}

std::optional<Refusal> Driving::stop(const ClientSession& session, uint32_t request_id,
                                     double now) {
  if (lease_.driver() == session.id) lease_.refresh(now);
  if (walk_.is_walking()) is_walk_blocked_ = true;
  walk_.abandon();
  // Sent even if nao-motion seems to be unavailable: it may still receive.
  commands_.send(session.id, request_id, commands_.make(session.id, StopCommand{}), now);
  if (components_.is_available(Component::kMotion)) return std::nullopt;
  return Refusal{naoremote::ROBOT_UNAVAILABLE, availability_reason(Component::kMotion, false)};
}

void Driving::stop_move_of(uint32_t client, const ClientSession& sender, double now) {
  if (!commands_.forget_client(client)) return;
  commands_.send(0, 0, commands_.make(sender.id, StopCommand{}), now);
}

void Driving::handle_result(const CommandResult& result) {
  const bool is_final = result.status != ResultStatus::kAccepted;
  const bool is_of_walk =
      walk_.is_walking() && result.id == walk_.command_id() && result.source == walk_.source();
  // The next WalkTurn begins a new walk with a new number.
  if (is_final && is_of_walk) walk_.abandon();
}

void Driving::end_walk(double now) {
  walk_.end(now);
  step(now);
}

void Driving::step(double now) {
  while (const auto command = walk_.step(now)) commands_.transmit(*command);
}

}  // namespace nao::gateway
