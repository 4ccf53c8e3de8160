#include "phone-gateway/server/core/driving.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "phone-gateway/server/core/client_name.h"

namespace nao::gateway {
namespace {

/** Fraction of the commanded velocity for a round-trip time, s, which a driver sees the robot
 * late by. */
double allowed_speed(const GatewayLimits& limits, double round_trip_time) {
  const double range = limits.max_round_trip - limits.full_speed_round_trip;
  return std::clamp((limits.max_round_trip - round_trip_time) / range, 0.0, 1.0);
}

/** A walk at which the robot steps in place: nao-motion ends a walk of all zero. m/s, chosen: no
 * robot moves by it. */
constexpr WalkCommand kInPlace{1e-6, 0, 0};

/** A walk that the limit changes by less is not sent again, m/s and rad/s. Chosen: not seen. */
constexpr double kSmallChange = 0.005;

}  // namespace

// ---- Control ------------------------------------------------------------------------------------

// nullopt: the client drives now. The walk of the driver before ends with its control.
std::optional<Refusal> Driving::take_control(const ClientSession& session, double now) {
  if (auto refusal = control_.check_taking(session, now)) return refusal;
  const uint32_t previous = control_.driver();
  control_.assign(session.id, now);
  if (previous == session.id) return std::nullopt;
  end_motion(now);
  is_walk_blocked_ = false;
  control_.audit("drives", session, "");
  control_.tell_all(gateway_reason("driver-changed", {session.name}));
  return std::nullopt;
}

void Driving::wait_for_control(const ClientSession& session) {
  if (control_.wait(session)) control_.tell_all(gateway_reason("control-asked", {session.name}));
}

void Driving::withdraw(const ClientSession& session) {
  if (!control_.withdraw(session.id)) return;
  control_.tell_all(gateway_reason("control-ask-withdrawn", {session.name}));
}

void Driving::release_control(const ClientSession& session, uint32_t successor, double now) {
  withdraw(session);
  if (control_.driver() != session.id) return;
  const ClientSession* next = control_.next();
  if (next != nullptr && next->id == successor) return assign_control(*next, now);
  end_motion(now);
  play_.release(now);
  control_.release(session.id);
  control_.audit("released", session, "");
  control_.tell_all(gateway_reason("control-released", {session.name}));
}

void Driving::assign_control(const ClientSession& session, double now) {
  if (control_.driver() == session.id) return;
  if (control_.driver() != 0) stop_move_of(control_.driver(), session, now);
  end_motion(now);
  control_.assign(session.id, now);
  // A joystick that is held for another robot must not walk this one.
  is_walk_blocked_ = true;
  last_walk_turn_ = now;
  control_.audit("drives", session, "assigned");
  control_.tell_all(gateway_reason("driver-changed", {session.name}));
}

void Driving::take_control_as_operator(const ClientSession& console, double now) {
  if (control_.driver() == kOperatorId) return;
  // The operator at the console takes over from any driver, and what it started ends.
  if (control_.driver() != 0) stop_move_of(control_.driver(), console, now);
  end_motion(now);
  control_.assign(kOperatorId, now);
  control_.audit("operator", console, "takes control");
  control_.tell_all(gateway_reason("driver-changed", {kOperatorName}));
}

void Driving::release_control_as_operator(const ClientSession& console, double now) {
  if (!control_.release(kOperatorId)) return;
  play_.release(now);
  control_.audit("operator", console, "releases control");
  control_.tell_all(gateway_reason("control-released", {kOperatorName}));
}

// A phone that vanishes stops the robot: walk and move-to end.
void Driving::handle_disconnect(const ClientSession& session, double now) {
  stop_move_of(session.id, session, now);
  withdraw(session);
  if (control_.driver() != session.id) return;
  end_motion(now);
  control_.release(session.id);
  control_.tell_all(gateway_reason("driver-disconnected", {session.name}));
}

// As a disconnection: the client no longer sees what the robot does.
void Driving::handle_departure(const ClientSession& session, const std::string& next_robot,
                               double now) {
  stop_move_of(session.id, session, now);
  withdraw(session);
  if (control_.driver() != session.id) return;
  end_motion(now);
  control_.release(session.id);
  control_.audit("released", session, "");
  control_.tell_all(gateway_reason("driver-left", {session.name, next_robot}));
}

// ---- Commands -----------------------------------------------------------------------------------

std::optional<Refusal> Driving::check_control(const ClientSession& session, double now) {
  if (auto refusal = control_.check(session)) return refusal;
  control_.refresh(now);
  return std::nullopt;
}

std::optional<Refusal> Driving::check_driving(const ClientSession& session, double now) {
  if (auto refusal = check_driver(session)) return refusal;
  control_.refresh(now);
  return std::nullopt;
}

std::optional<Refusal> Driving::check_driver(const ClientSession& session) const {
  if (auto refusal = control_.check(session)) return refusal;
  // Only now: without control the client learns nothing about the robot's state here.
  if (components_.is_available(Component::kRobot)) return std::nullopt;
  const bool has_motion = components_.is_available(Component::kMotion);
  return Refusal{naoremote::ROBOT_UNAVAILABLE,
                 availability_reason(has_motion ? Component::kRobot : Component::kMotion, false)};
}

std::optional<Refusal> Driving::walk(const ClientSession& session, uint32_t request_id,
                                     const WalkCommand& velocity, bool is_held, double now) {
  if (auto refusal = check_driver(session)) return refusal;
  control_.refresh(now);
  if (is_held && is_zero(velocity)) {
    requested_walk_ = {};
    step_in_place(now);
    return std::nullopt;
  }
  const bool was_released = now - last_walk_turn_ >= limits_.walk_timeout;
  last_walk_turn_ = now;
  if (is_zero(velocity)) {
    is_walk_blocked_ = false;
    end_walk(now);
    return std::nullopt;
  }
  // After a Stop a held joystick must not start the walk again. The driver has released it after a
  // zero velocity, or after as long a pause as ends a walk.
  if (was_released) is_walk_blocked_ = false;
  if (is_walk_blocked_) return Refusal{naoremote::STOPPED, gateway_reason("walk-stopped")};
  const double fraction = allowed_speed(limits_, session.round_trip_time);
  if (fraction <= 0) {
    end_walk(now);
    return Refusal{naoremote::TOO_LATE,
                   gateway_reason("link-too-slow", {to_argument(session.round_trip_time)})};
  }
  requested_walk_ = {fraction * velocity.vx, fraction * velocity.vy, fraction * velocity.wz};
  const WalkCommand allowed = calc_allowed_walk();
  if (is_zero(allowed)) {
    step_in_place(now);
    return std::nullopt;
  }
  if (is_walking_) {
    walk_.request = allowed;
    commands_.update_walk(walk_, now);
    return std::nullopt;
  }
  play_.abandon();
  abandon_walk();
  walk_ = commands_.make(session.id, allowed);
  is_walking_ = true;
  commands_.send({session.id, request_id}, walk_, now);
  return std::nullopt;
}

std::optional<Refusal> Driving::command(const ClientSession& session, uint32_t request_id,
                                        decltype(Command::request) request, double now) {
  if (auto refusal = check_driver(session)) return refusal;
  control_.refresh(now);
  // Head and arms may move during a walk; any other command replaces it. The walk is abandoned, not
  // ended: a zero velocity after the new command would end that one.
  if (!std::holds_alternative<JointChangeCommand>(request)) abandon_walk();
  // Any command ends a behavior: nao-play listens, too.
  play_.abandon();
  commands_.send({session.id, request_id}, commands_.make(session.id, std::move(request)), now);
  return std::nullopt;
}

std::optional<Refusal> Driving::play(const ClientSession& session, uint32_t request_id,
                                     const PlayCommand& command, double now) {
  if (auto refusal = check_driver(session)) return refusal;
  control_.refresh(now);
  if (command.behavior == Behavior::kNone) {
    play_.end(now);
    return std::nullopt;
  }
  // Without zeros, which would end the behavior's walk.
  abandon_walk();
  play_.begin(session.id, request_id, command, now);
  return std::nullopt;
}

std::optional<Refusal> Driving::stop(const ClientSession& session, uint32_t request_id,
                                     double now) {
  if (control_.driver() == session.id) control_.refresh(now);
  if (is_walking_) is_walk_blocked_ = true;
  // A stop needs no control: any client that sees the robot in danger may stop it.
  abandon_walk();
  play_.end(now);
  // Sent even if nao-motion seems to be unavailable: it may still receive.
  commands_.send({session.id, request_id}, commands_.make(session.id, StopCommand{}), now);
  if (components_.is_available(Component::kMotion)) return std::nullopt;
  return Refusal{naoremote::ROBOT_UNAVAILABLE, availability_reason(Component::kMotion, false)};
}

// No client waits for the result: 0.
void Driving::stop_move_of(uint32_t client, const ClientSession& sender, double now) {
  if (!commands_.forget_client(client)) return;
  commands_.send({}, commands_.make(sender.id, StopCommand{}), now);
}

void Driving::handle_result(const CommandResult& result) {
  const bool is_final = result.status != ResultStatus::kAccepted;
  const bool is_of_walk = result.id == walk_.id && result.source == walk_.source;
  // The next WalkTurn begins a new walk with a new number.
  if (is_final && is_of_walk) is_walking_ = false;
}

void Driving::command_by_itself(decltype(Command::request) request, double now) {
  abandon_walk();
  play_.abandon();
  commands_.send({}, commands_.make(0, std::move(request)), now);
}

void Driving::follow_limit(double now) {
  if (!limit_walk_ || !is_walking_ || is_zero(requested_walk_)) return;
  const WalkCommand allowed = calc_allowed_walk();
  if (is_zero(allowed)) return step_in_place(now);
  const WalkCommand& sent = std::get<WalkCommand>(walk_.request);
  const double change = std::max({std::abs(allowed.vx - sent.vx), std::abs(allowed.vy - sent.vy),
                                  std::abs(allowed.wz - sent.wz)});
  if (change < kSmallChange) return;
  walk_.request = allowed;
  commands_.update_walk(walk_, now);
}

void Driving::end_walk(double now) {
  if (std::exchange(is_walking_, false)) commands_.end_walk(walk_, now);
}

void Driving::step_in_place(double now) {
  if (!is_walking_ || std::get<WalkCommand>(walk_.request).vx == kInPlace.vx) return;
  walk_.request = kInPlace;
  commands_.update_walk(walk_, now);
}

void Driving::abandon_walk() {
  is_walking_ = false;
  commands_.abandon_walk(walk_);
}

void Driving::end_motion(double now) {
  end_walk(now);
  play_.end(now);
}

void Driving::step(double now) {
  // A client whose robot acts by itself drives it.
  if (play_.is_active()) control_.refresh(now);
  const double silence = now - last_walk_turn_;
  if (silence >= limits_.walk_end_timeout) {
    if (is_walking_) {
      control_.tell_driver(
          gateway_reason("walk-link-lost", {to_argument(limits_.walk_end_timeout)}));
    }
    end_walk(now);
  } else if (silence >= limits_.walk_timeout) {
    step_in_place(now);
  } else {
    follow_limit(now);
  }
}

}  // namespace nao::gateway
