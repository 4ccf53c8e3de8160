#include "phone-gateway/server/core/operator_console.h"

namespace nao::gateway {

using naoremote::Operate;

std::optional<Refusal> OperatorConsole::execute(const ClientSession& console,
                                                const Operate& request,
                                                naoremote::Response& response, double now) {
  if (!console.endpoint.is_local && !console.endpoint.is_operator) {
    return Refusal{naoremote::NOT_ALLOWED, gateway_reason("operator-only")};
  }
  switch (request.operation()) {
    case Operate::LIST:
      list_clients(*response.mutable_clients());
      return std::nullopt;
    case Operate::TAKE:
    case Operate::RELEASE:
      return take(console, request.robot(), request.operation() == Operate::TAKE, now);
    case Operate::KICK:
    case Operate::MUTE:
    case Operate::UNMUTE:
    case Operate::ASSIGN:
      break;
    default:
      return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("operation-unknown")};
  }
  ClientSession* client = sessions_.find(request.client_id());
  if (client == nullptr || !client->is_connected) {
    return Refusal{naoremote::INVALID_ARGUMENT,
                   gateway_reason("client-unknown", {std::to_string(request.client_id())})};
  }
  if (request.operation() == Operate::ASSIGN) return assign(*client, request.robot(), now);
  if (request.operation() == Operate::KICK) {
    sessions_.audit("operator", *client, "closes the connection of this client");
    sessions_.close(*client, gateway_reason("closed-by-operator"), now);
  } else {
    mute(*client, request.operation() == Operate::MUTE, now);
  }
  return std::nullopt;
}

std::optional<Refusal> OperatorConsole::take(const ClientSession& console, const std::string& robot,
                                             bool takes, double now) {
  if (!robot.empty() && !robots_.find(robot)) return robots_.refuse_unknown(robot);
  for (size_t i = 0; i < robots_.size(); ++i) {
    if (!robot.empty() && robots_.at(i).name() != robot) continue;
    Driving& driving = robots_.at(i).driving();
    if (takes) {
      driving.take_control_as_operator(console, now);
    } else {
      driving.release_control_as_operator(console, now);
    }
  }
  return std::nullopt;
}

std::optional<Refusal> OperatorConsole::assign(ClientSession& client, const std::string& robot,
                                               double now) {
  const std::optional<size_t> index = robot.empty() ? client.robot : robots_.find(robot);
  if (!index) return robots_.refuse_unknown(robot);
  if (client.is_muted) {
    return Refusal{naoremote::INVALID_ARGUMENT, gateway_reason("client-muted", {client.name})};
  }
  robots_.change(client, *index, now);
  robots_.at(*index).driving().assign_control(client, now);
  return std::nullopt;
}

void OperatorConsole::mute(ClientSession& client, bool is_muted, double now) {
  // An invitation for watching stays one.
  if (client.is_muted == is_muted || client.endpoint.is_watcher) return;
  Driving& driving = robots_.of(client).driving();
  sessions_.audit("operator", client,
                  is_muted ? "lets this client watch only" : "lets this client drive again");
  client.is_muted = is_muted;
  driving.release_control(client, 0, now);
  driving.control().tell(client, is_muted ? gateway_reason("muted-by-operator")
                                          : gateway_reason("unmuted-by-operator"));
}

void OperatorConsole::list_clients(naoremote::Clients& clients) const {
  for (const auto& [id, session] : sessions_.all()) {
    if (!session->is_connected) continue;
    const GatewayRobot& robot = robots_.of(*session);
    naoremote::Clients::Client& client = *clients.add_clients();
    client.set_client_id(id);
    client.set_name(session->name);
    client.set_address(session->endpoint.address);
    client.set_transport(session->endpoint.transport);
    client.set_is_driver(robot.driving().driver() == id);
    client.set_num_sent(session->num_sent);
    client.set_num_skipped(session->outbox.num_skipped());
    if (robots_.size() > 1) client.set_robot(robot.name());
    client.set_is_muted(session->is_muted);
  }
}

}  // namespace nao::gateway
