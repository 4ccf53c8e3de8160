// The use cases of remote.proto.
#include <algorithm>
#include <cmath>
#include <utility>

#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/client_name.h"
#include "phone-gateway/server/gateway_core.h"
#include "phone-gateway/server/secret.h"

namespace nao {
namespace {

using naoremote::ErrorCode;
using naoremote::Response;

constexpr size_t kMaxRememberedAddresses = 256;
constexpr double kGoldenRatio = 0.6180339887;

void refuse(Response& response, ErrorCode error, const std::string& message) {
  response.set_error(error);
  response.set_message(message);
}

}  // namespace

void GatewayCore::answer(PhoneSession& session, const Request& request, Response& response,
                         double now) {
  const bool is_console = request.has_operate() && session.peer.is_local;
  if (!session.is_connected && !request.has_connect() && !is_console &&
      request.use_case_case() != Request::USE_CASE_NOT_SET) {
    refuse(response, naoremote::NOT_CONNECTED, "Connect comes first.");
    return;
  }
  switch (request.use_case_case()) {
    case Request::kConnect:
      connect(session, request.connect(), response, now);
      return;
    case Request::kGetState:
      get_state(session, request.get_state(), response, now);
      return;
    case Request::kSubscribe:
      subscribe(session, request.subscribe(), response);
      return;
    case Request::kWalkTurn:
      walk_turn(session, request, response, now);
      return;
    case Request::kMoveTo:
      move(session, request, check(request.move_to()), response, now);
      return;
    case Request::kGoToPosture:
      move(session, request, check(request.go_to_posture(), robot_), response, now);
      return;
    case Request::kChangeJoints:
      move(session, request, check(request.change_joints(), robot_), response, now);
      return;
    case Request::kDoAction:
      move(session, request, check(request.do_action(), robot_), response, now);
      return;
    case Request::kStop:
      stop(session, request, response, now);
      return;
    case Request::kTakeControl:
      take_control(session, response, now);
      return;
    case Request::kReleaseControl:
      if (lease_.driver() == session.id) {
        end_walk(now);
        lease_.release(session.id);
        audit("released", session, "");
        session.tells_control_changed = session.name + " gave back control; nobody drives.";
      }
      *response.mutable_control() = control_for(session);
      return;
    case Request::kPing:
      response.mutable_pong()->set_client_utime(request.ping().client_utime());
      response.mutable_pong()->set_robot_utime(
          static_cast<uint64_t>(mirror_.calc_robot_utime(now)));
      response.mutable_pong()->set_num_clients(static_cast<uint32_t>(num_connected()));
      return;
    case Request::kOperate:
      operate(session, request.operate(), response, now);
      return;
    case Request::USE_CASE_NOT_SET:
      refuse(response, naoremote::INVALID_REQUEST, "The request names no use case known here.");
      return;
  }
}

// ---- Connect ------------------------------------------------------------------------------------

int GatewayCore::num_connected() const {
  return static_cast<int>(std::count_if(sessions_.begin(), sessions_.end(), [](const auto& item) {
    return item.second->is_connected;
  }));
}

bool GatewayCore::is_right_token(const PhoneSession& session, const std::string& token) const {
  if (session.peer.is_local && token.empty()) return true;
  return !identity_.token.empty() && equals_secret(token, identity_.token);
}

bool GatewayCore::admit(const PhoneSession& session, const naoremote::Connect& request,
                        Response& response, double now) {
  if (request.protocol_version() != kProtocolVersion) {
    refuse(response, naoremote::WRONG_VERSION,
           "This gateway speaks version 1 of the protocol, not " +
               std::to_string(request.protocol_version()) + ".");
    return false;
  }
  const std::string& address = session.peer.address;
  const auto tries = wrong_tokens_.find(address);
  if (tries != wrong_tokens_.end() && tries->second.count >= limits_.max_wrong_tokens &&
      now - tries->second.last < limits_.wrong_token_pause) {
    refuse(response, naoremote::WRONG_TOKEN, "Too many wrong tokens: wait 10 s.");
    return false;
  }
  if (!is_right_token(session, request.token())) {
    if (wrong_tokens_.size() >= kMaxRememberedAddresses) wrong_tokens_.clear();
    WrongTokens& wrong = wrong_tokens_[address];
    if (wrong.count >= limits_.max_wrong_tokens) wrong.count = 0;
    ++wrong.count;
    wrong.last = now;
    refuse(response, naoremote::WRONG_TOKEN,
           "The token is wrong or missing: open the address that the gateway printed, or scan its "
           "code.");
    return false;
  }
  wrong_tokens_.erase(address);
  const auto num_same_address =
      std::count_if(sessions_.begin(), sessions_.end(), [&](const auto& item) {
        return item.second->is_connected && item.second->peer.address == address;
      });
  if (num_connected() >= limits_.max_clients) {
    refuse(response, naoremote::TOO_MANY_CLIENTS,
           std::to_string(limits_.max_clients) + " clients are connected already.");
    return false;
  }
  if (!session.peer.is_local && num_same_address >= limits_.max_clients_per_address) {
    refuse(response, naoremote::TOO_MANY_CLIENTS, "Too many clients from this address.");
    return false;
  }
  return true;
}

std::string GatewayCore::unique_name(const std::string& wished, uint32_t client) const {
  std::string base = clean_client_name(wished);
  if (base.empty()) base = "phone " + std::to_string(client);
  const auto is_taken = [this](const std::string& name) {
    return name == kOperatorName ||
           std::any_of(sessions_.begin(), sessions_.end(), [&](const auto& item) {
             return item.second->is_connected && item.second->name == name;
           });
  };
  std::string name = base;
  for (int i = 2; is_taken(name); ++i) name = base + " " + std::to_string(i);
  return name;
}

void GatewayCore::connect(PhoneSession& session, const naoremote::Connect& request,
                          Response& response, double now) {
  if (session.is_connected) {
    refuse(response, naoremote::INVALID_ARGUMENT, "This client is connected already.");
    return;
  }
  if (!admit(session, request, response, now)) {
    session.name = clean_client_name(request.client_name());
    // The code, since the sentence may hold what the client sent: who repeats a refusal in ever new
    // words shall not fill the log.
    audit("refused", session, naoremote::ErrorCode_Name(response.error()));
    session.is_refused = true;
    session.closes_because = response.message();
    return;
  }
  session.name = unique_name(request.client_name(), session.id);
  session.is_connected = true;
  audit("connected", session, clean_client_name(request.client_software()));
  naoremote::Connected& connected = *response.mutable_connected();
  connected.set_protocol_version(kProtocolVersion);
  connected.set_server_version(identity_.server_version);
  connected.set_client_id(session.id);
  connected.set_client_name(session.name);
  *connected.mutable_robot() = robot_.description;
  *connected.mutable_control() = control_for(session);
  session.tells_missing_parts = true;
}

// ---- State and image --------------------------------------------------------------------------

void GatewayCore::get_state(PhoneSession& session, const naoremote::GetState& request,
                            Response& response, double now) {
  auto choice = check(request.image(), robot_);
  if (const auto* refusal = std::get_if<Refusal>(&choice)) {
    refuse(response, naoremote::INVALID_ARGUMENT, refusal->message);
    return;
  }
  if (request.with_image()) {
    session.polled_image = std::get<ImageSelection>(choice);
    session.last_poll = now;
  }
  if (!mirror_.has_state()) {
    refuse(response, naoremote::ROBOT_UNAVAILABLE, "Nothing has been heard of the robot yet.");
    return;
  }
  naoremote::StateAndImage& result = *response.mutable_state_and_image();
  mirror_.write(*result.mutable_state(), parts_.is_available(PartMonitor::Part::kRobot), now);
  if (!request.with_image()) return;
  if (const StoredImage* image = images_.find(session.polled_image, session.last_image)) {
    session.last_image = image->number;
    write_image(*image, *result.mutable_image(), now);
  }
}

void GatewayCore::subscribe(PhoneSession& session, const naoremote::Subscribe& request,
                            Response& response) {
  auto checked = check(request, robot_, limits_);
  if (const auto* refusal = std::get_if<Refusal>(&checked)) {
    refuse(response, naoremote::INVALID_ARGUMENT, refusal->message);
    return;
  }
  session.subscription = std::get<Subscription>(checked);
  // Each client in a phase of its own, evenly spread for any number of them: one state does not
  // serve all at once, the last of whom would wait for the first.
  const double phase = std::fmod(session.id * kGoldenRatio, 1);
  session.state_pacer = Pacer(session.subscription.state_rate, phase);
  session.image_pacer = Pacer(session.subscription.image_rate);
}

// ---- Driving ------------------------------------------------------------------------------------

bool GatewayCore::may_drive(const PhoneSession& session, Response& response) {
  if (lease_.driver() == 0) {
    refuse(response, naoremote::NO_CONTROL, "Nobody drives: take control first.");
    return false;
  }
  if (lease_.driver() != session.id) {
    refuse(response, naoremote::CONTROL_TAKEN, driver_name() + " drives.");
    *response.mutable_control() = control_for(session);
    return false;
  }
  if (!parts_.is_available(PartMonitor::Part::kRobot)) {
    const bool has_motion = parts_.is_available(PartMonitor::Part::kMotion);
    refuse(response, naoremote::ROBOT_UNAVAILABLE,
           describe({has_motion ? PartMonitor::Part::kRobot : PartMonitor::Part::kMotion, false}));
    return false;
  }
  return true;
}

void GatewayCore::walk_turn(PhoneSession& session, const Request& request, Response& response,
                            double now) {
  auto checked = check(request.walk_turn(), robot_);
  if (const auto* refusal = std::get_if<Refusal>(&checked)) {
    refuse(response, naoremote::INVALID_ARGUMENT, refusal->message);
    return;
  }
  if (!may_drive(session, response)) return;
  lease_.refresh(now);
  const bool had_let_go = now - last_walk_turn_ >= limits_.walk_stale_time;
  last_walk_turn_ = now;
  const auto& velocity = std::get<WalkVelocity>(checked);
  if (velocity.vx == 0 && velocity.vy == 0 && velocity.wz == 0) {
    is_walk_held_ = false;
    end_walk(now);
    return;
  }
  if (had_let_go) is_walk_held_ = false;
  if (is_walk_held_) {
    refuse(response, naoremote::STOPPED, "Stopped: let go of the joystick, then walk on.");
    return;
  }
  if (!walk_.is_walking()) {
    const NumberedCommand begun = number(session, velocity);
    walk_.begin(begun.source, begun.command_id);
    for (const CommandTracker::Entry& entry : commands_.supersede(begun.command)) {
      tell_outcome(entry, CommandStatus::kInterrupted, "A walk came before it was heard.", now);
    }
    commands_.add(session.id, request.request_id(), begun, now);
  }
  outputs_.send(walk_.update(velocity, now));
}

void GatewayCore::move(PhoneSession& session, const Request& request,
                       std::variant<MotionCommand, Refusal> checked, Response& response,
                       double now) {
  if (const auto* refusal = std::get_if<Refusal>(&checked)) {
    refuse(response, naoremote::INVALID_ARGUMENT, refusal->message);
    return;
  }
  if (!may_drive(session, response)) return;
  lease_.refresh(now);
  auto& command = std::get<MotionCommand>(checked);
  // Head and arms may move during a walk; anything else takes its place.
  if (!std::holds_alternative<JointChange>(command)) walk_.abandon();
  send_event(session.id, request.request_id(), number(session, std::move(command)), now);
}

void GatewayCore::stop(PhoneSession& session, const Request& request, Response& response,
                       double now) {
  if (lease_.driver() == session.id) lease_.refresh(now);
  if (walk_.is_walking()) is_walk_held_ = true;
  walk_.abandon();
  // Also when nothing is heard of nao-motion: it may still hear.
  send_event(session.id, request.request_id(), number(session, StopMotion{}), now);
  if (!parts_.is_available(PartMonitor::Part::kMotion)) {
    refuse(response, naoremote::ROBOT_UNAVAILABLE, describe({PartMonitor::Part::kMotion, false}));
  }
}

void GatewayCore::take_control(PhoneSession& session, Response& response, double now) {
  const uint32_t previous = lease_.driver();
  if (!lease_.take(session.id, now)) {
    refuse(response, naoremote::CONTROL_TAKEN, driver_name() + " drives.");
    *response.mutable_control() = control_for(session);
    return;
  }
  *response.mutable_control() = control_for(session);
  if (previous == session.id) return;
  end_walk(now);
  is_walk_held_ = false;
  audit("drives", session, "");
  session.tells_control_changed = session.name + " drives now.";
}

// ---- Operator's console -------------------------------------------------------------------------

void GatewayCore::operate(PhoneSession& session, const naoremote::Operate& request,
                          Response& response, double now) {
  if (!session.peer.is_local) {
    refuse(response, naoremote::NOT_ALLOWED, "Only the gateway's own host may operate it.");
    return;
  }
  switch (request.operation()) {
    case naoremote::Operate::LIST:
      for (const auto& [id, other] : sessions_) {
        if (!other->is_connected) continue;
        naoremote::Clients::Client* client = response.mutable_clients()->add_clients();
        client->set_client_id(id);
        client->set_name(other->name);
        client->set_address(other->peer.address);
        client->set_transport(other->peer.transport);
        client->set_is_driver(lease_.driver() == id);
        client->set_num_sent(other->num_sent);
        client->set_num_skipped(other->outbox.num_skipped());
      }
      // Present also when nobody is connected.
      response.mutable_clients();
      return;
    case naoremote::Operate::TAKE:
      if (lease_.driver() == kOperatorId) return;
      if (lease_.driver() != 0 && commands_.forget_client(lease_.driver())) {
        send_event(0, 0, number(session, StopMotion{}), now);
      }
      end_walk(now);
      lease_.take(kOperatorId, now);
      audit("operator", session, "takes control");
      session.tells_control_changed = "The operator drives now.";
      return;
    case naoremote::Operate::RELEASE:
      if (!lease_.release(kOperatorId)) return;
      audit("operator", session, "gives back control");
      session.tells_control_changed = "The operator gave back control; nobody drives.";
      return;
    case naoremote::Operate::KICK: {
      PhoneSession* other = find(request.client_id());
      if (other == nullptr || !other->is_connected) {
        refuse(response, naoremote::INVALID_ARGUMENT, "No client has that number.");
        return;
      }
      audit("operator", *other, "closes the connection of this client");
      close_session(*other, "The operator closed this connection.", now);
      return;
    }
    default:
      refuse(response, naoremote::INVALID_ARGUMENT, "Operations: LIST, TAKE, RELEASE, KICK.");
  }
}

}  // namespace nao
