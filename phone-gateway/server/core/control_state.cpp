#include "phone-gateway/server/core/control_state.h"

#include "phone-gateway/server/core/client_name.h"

namespace nao::gateway {
namespace {

Refusal refuse_muted() {
  return {naoremote::NOT_ALLOWED, gateway_reason("muted-by-operator")};
}

}  // namespace

std::string ControlState::driver_name() const {
  if (driver() == kOperatorId) return kOperatorName;
  const ClientSession* session = sessions_.find(driver());
  return session == nullptr ? "" : session->name;
}

naoremote::Control ControlState::describe(const ClientSession& session) const {
  naoremote::Control control;
  control.set_driver_id(driver());
  control.set_driver_name(driver_name());
  control.set_is_mine(driver() == session.id);
  control.set_is_muted(session.is_muted);
  if (const ClientSession* waiting = next()) {
    control.set_next_id(waiting->id);
    control.set_next_name(waiting->name);
  }
  return control;
}

bool ControlState::wait(const ClientSession& session) {
  if (driver() == 0 || driver() == kOperatorId || session.is_muted || next() != nullptr)
    return false;
  next_ = session.id;
  return true;
}

bool ControlState::withdraw(uint32_t client) {
  if (next_ != client || client == 0) return false;
  next_ = 0;
  return true;
}

bool ControlState::release(uint32_t client) {
  if (!lease_.release(client)) return false;
  next_ = 0;
  return true;
}

std::optional<Refusal> ControlState::check_taking(const ClientSession& session, double now) const {
  if (session.is_muted) return refuse_muted();
  if (session.endpoint.is_operator && driver() != kOperatorId) return std::nullopt;
  if (!lease_.can_take(session.id, now)) return refuse();
  return std::nullopt;
}

std::optional<Refusal> ControlState::check(const ClientSession& session) const {
  if (session.is_muted) return refuse_muted();
  if (driver() == 0) return Refusal{naoremote::NO_CONTROL, gateway_reason("no-driver")};
  if (driver() != session.id) return refuse();
  return std::nullopt;
}

Refusal ControlState::refuse() const {
  return {naoremote::CONTROL_TAKEN, gateway_reason("control-taken", {driver_name()})};
}

void ControlState::tell(ClientSession& session, const Reason& reason) const {
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::CONTROL_CHANGED);
  write_reason(reason, notice);
  *notice.mutable_control() = describe(session);
  session.send(message);
}

void ControlState::tell_driver(const Reason& reason) const {
  ClientSession* session = sessions_.find(driver());
  if (session == nullptr) return;
  naoremote::ServerMessage message;
  message.mutable_notice()->set_kind(naoremote::Notice::WALK_ENDED);
  write_reason(reason, *message.mutable_notice());
  session->send(message);
}

void ControlState::tell_all(const Reason& reason) const {
  // Each client gets its own copy: `is_mine` differs.
  sessions_.for_each([&](ClientSession& session) { tell(session, reason); });
}

void ControlState::audit(const std::string& event, const ClientSession& session,
                         const std::string& detail) const {
  const std::string& robot = sessions_.label();
  const std::string separator = robot.empty() || detail.empty() ? "" : ": ";
  sessions_.all().audit(event, session, robot + separator + detail);
}

}  // namespace nao::gateway
