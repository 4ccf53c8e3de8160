#include "phone-gateway/server/core/request_handler.h"

#include <utility>
#include <variant>

#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/core/request_check.h"

namespace nao::gateway {
namespace {

using naoremote::Request;
using naoremote::Response;

/** Executes a request whose fields have been checked; passes on the refusal of the check. */
template <class Checked, class Execute>
std::optional<Refusal> execute_checked(std::variant<Checked, Refusal> checked, Execute execute) {
  if (auto* refusal = std::get_if<Refusal>(&checked)) return std::move(*refusal);
  return execute(std::get<Checked>(std::move(checked)));
}

}  // namespace

naoremote::ServerMessage make_component_notice(const ComponentMonitor::Change& change) {
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::COMPONENT_CHANGED);
  write_reason(availability_reason(change.component, change.is_available), notice);
  notice.set_component(static_cast<naoremote::Notice::Component>(change.component));
  notice.set_is_available(change.is_available);
  return message;
}

void RequestHandler::handle(ClientSession& session, const Request& request, Response& response,
                            double now) {
  const auto refusal = execute(session, request, response, now);
  if (!refusal) return;
  response.set_error(refusal->error);
  write_reason(refusal->reason, response);
  // So that the app can say who drives.
  if (refusal->error == naoremote::CONTROL_TAKEN) {
    *response.mutable_control() = objects_.driving.describe_control(session);
  }
}

std::optional<Refusal> RequestHandler::execute(ClientSession& session, const Request& request,
                                               Response& response, double now) {
  // The operator's console on the gateway's host needs no token.
  const bool is_console = request.has_operate() && session.endpoint.is_local;
  if (!session.is_connected && !request.has_connect() && !is_console &&
      request.use_case_case() != Request::USE_CASE_NOT_SET) {
    return Refusal{naoremote::NOT_CONNECTED, gateway_reason("not-connected")};
  }
  Driving& driving = objects_.driving;
  const uint32_t id = request.request_id();
  const auto send_command = [&](auto command) {
    return driving.command(session, id, std::move(command), now);
  };
  switch (request.use_case_case()) {
    case Request::kConnect:
      return connect(session, request.connect(), response, now);
    case Request::kGetState:
      return get_state(session, request.get_state(), response, now);
    case Request::kSubscribe:
      return subscribe(session, request.subscribe());
    case Request::kWalkTurn:
      return execute_checked(check(request.walk_turn(), robot_), [&](const WalkCommand& velocity) {
        return driving.walk(session, id, velocity, now);
      });
    case Request::kMoveTo:
      return execute_checked(check(request.move_to()), send_command);
    case Request::kGoToPosture:
      return execute_checked(check(request.go_to_posture(), robot_), send_command);
    case Request::kChangeJoints:
      return execute_checked(check(request.change_joints(), robot_), send_command);
    case Request::kDoAction:
      return execute_checked(check(request.do_action(), robot_), send_command);
    case Request::kStop:
      return driving.stop(session, id, now);
    case Request::kTakeControl:
      if (auto refusal = driving.take_control(session, now)) return refusal;
      *response.mutable_control() = driving.describe_control(session);
      return std::nullopt;
    case Request::kReleaseControl:
      driving.release_control(session, now);
      *response.mutable_control() = driving.describe_control(session);
      return std::nullopt;
    case Request::kPing:
      ping(request.ping(), *response.mutable_pong(), now);
      return std::nullopt;
    case Request::kOperate:
      return operate(session, request.operate(), response, now);
    case Request::USE_CASE_NOT_SET:
      break;
  }
  return Refusal{naoremote::INVALID_REQUEST, gateway_reason("use-case-unknown")};
}

std::optional<Refusal> RequestHandler::connect(ClientSession& session,
                                               const naoremote::Connect& request,
                                               Response& response, double now) {
  if (session.is_connected)
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("already-connected")};
  if (auto refusal = admission_.check(session.endpoint, request, objects_.sessions, now)) {
    // The answer with the reason is sent before the connection closes.
    objects_.sessions.refuse(session, request, refusal->reason, now);
    return refusal;
  }
  objects_.sessions.connect(session, request);
  naoremote::Connected& connected = *response.mutable_connected();
  connected.set_protocol_version(kProtocolVersion);
  connected.set_server_version(server_version_);
  connected.set_client_id(session.id);
  connected.set_client_name(session.name);
  *connected.mutable_robot() = robot_;
  *connected.mutable_control() = objects_.driving.describe_control(session);
  for (const Component component : kComponents) {
    // A new client is told once what is missing; later changes come as notices to all.
    if (!objects_.components.is_available(component)) {
      session.send(make_component_notice({component, false}));
    }
  }
  return std::nullopt;
}

std::optional<Refusal> RequestHandler::get_state(ClientSession& session,
                                                 const naoremote::GetState& request,
                                                 Response& response, double now) {
  auto checked = check(request.image(), robot_);
  if (auto* refusal = std::get_if<Refusal>(&checked)) return std::move(*refusal);
  naoremote::StateAndImage result;
  const ImageSelection* selection =
      request.with_image() ? &std::get<ImageSelection>(checked) : nullptr;
  if (!objects_.streams.get(session, selection, now, result)) {
    return Refusal{naoremote::ROBOT_UNAVAILABLE, gateway_reason("no-state-yet")};
  }
  *response.mutable_state_and_image() = std::move(result);
  return std::nullopt;
}

std::optional<Refusal> RequestHandler::subscribe(ClientSession& session,
                                                 const naoremote::Subscribe& request) {
  return execute_checked(check(request, robot_, limits_),
                         [&](const Subscription& subscription) -> std::optional<Refusal> {
                           objects_.streams.subscribe(session, subscription);
                           return std::nullopt;
                         });
}

void RequestHandler::ping(const naoremote::Ping& request, naoremote::Pong& pong, double now) const {
  pong.set_client_utime(request.client_utime());
  // With the round-trip time a client computes the age of states without a common clock.
  pong.set_robot_utime(static_cast<uint64_t>(objects_.streams.calc_robot_utime(now)));
  pong.set_num_clients(static_cast<uint32_t>(objects_.sessions.num_connected()));
}

std::optional<Refusal> RequestHandler::operate(ClientSession& session,
                                               const naoremote::Operate& request,
                                               Response& response, double now) {
  if (!session.endpoint.is_local) {
    return Refusal{naoremote::NOT_ALLOWED, gateway_reason("operator-only")};
  }
  switch (request.operation()) {
    case naoremote::Operate::LIST:
      list_clients(*response.mutable_clients());
      return std::nullopt;
    case naoremote::Operate::TAKE:
      objects_.driving.take_control_as_operator(session, now);
      return std::nullopt;
    case naoremote::Operate::RELEASE:
      objects_.driving.release_control_as_operator(session);
      return std::nullopt;
    case naoremote::Operate::KICK: {
      ClientSession* other = objects_.sessions.find(request.client_id());
      if (other == nullptr || !other->is_connected) {
        return Refusal{naoremote::INVALID_ARGUMENT,
                       gateway_reason("client-unknown", {std::to_string(request.client_id())})};
      }
      objects_.sessions.audit("operator", *other, "closes the connection of this client");
      objects_.sessions.close(*other, gateway_reason("closed-by-operator"), now);
      return std::nullopt;
    }
    default:
      return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("operation-unknown")};
  }
}

void RequestHandler::list_clients(naoremote::Clients& clients) const {
  for (const auto& [id, session] : objects_.sessions.all()) {
    if (!session->is_connected) continue;
    naoremote::Clients::Client& client = *clients.add_clients();
    client.set_client_id(id);
    client.set_name(session->name);
    client.set_address(session->endpoint.address);
    client.set_transport(session->endpoint.transport);
    client.set_is_driver(objects_.driving.driver() == id);
    client.set_num_sent(session->num_sent);
    client.set_num_skipped(session->outbox.num_skipped());
  }
}

}  // namespace nao::gateway
