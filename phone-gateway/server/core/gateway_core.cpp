#include "phone-gateway/server/core/gateway_core.h"

#include <utility>

#include "phone-gateway/protocol/framing.h"

namespace nao::gateway {
namespace {

/** Pause of a connection whose client sends too fast or does not read, s: one step of the gateway.
 */
constexpr double kReadPause = 0.02;

}  // namespace

GatewayCore::GatewayCore(naoremote::RobotDescription robot, const GatewayLimits& limits,
                         const GatewayIdentity& identity, GatewayOutputs outputs)
    : limits_(limits),
      audit_(outputs.audit),
      sessions_(limits, std::move(outputs.audit)),
      components_(limits),
      streams_(limits, sessions_, components_),
      commands_(limits, sessions_, identity.source, identity.first_command_id,
                std::move(outputs.send)),
      driving_(limits, sessions_, components_, commands_),
      requests_(limits, std::move(robot), identity.server_version, identity.token,
                {sessions_, components_, driving_, streams_}) {
  sessions_.on_disconnect([this](const ClientSession& session, double now) {
    driving_.handle_disconnect(session, now);
  });
}

// ---- Connections --------------------------------------------------------------------------------

double GatewayCore::receive(uint32_t client, std::string_view message, double now) {
  ClientSession* session = sessions_.find(client);
  if (session == nullptr || session->is_closing) return 0;
  session->last_request = now;
  ++session->num_requests;

  naoremote::ServerMessage answer;
  naoremote::Response& response = *answer.mutable_response();
  naoremote::Request request;
  const bool is_request = message.size() <= kMaxRequestBytes &&
                          request.ParseFromArray(message.data(), static_cast<int>(message.size()));
  if (is_request) response.set_request_id(request.request_id());
  const bool has_budget = session->budget.take(now);
  // A request may cause notices to the same client. The answer goes before them.
  const size_t position = session->outbox.num_messages();
  if (!is_request) {
    response.set_error(naoremote::INVALID_REQUEST);
    write_reason(gateway_reason("not-a-request"), response);
  } else if (!has_budget && !request.has_stop()) {
    response.set_error(naoremote::TOO_MANY_REQUESTS);
    write_reason(gateway_reason("too-many-requests", {to_argument(limits_.max_request_rate)}),
                 response);
  } else {
    requests_.handle(*session, request, response, now);
  }
  if (response.error() != naoremote::OK) ++session->num_refused;
  session->outbox.insert(position, encode(answer));
  session->wake();
  if (!is_request && ++session->num_malformed > limits_.max_malformed_requests) {
    sessions_.close(*session,
                    gateway_reason("too-many-malformed-requests",
                                   {std::to_string(limits_.max_malformed_requests)}),
                    now);
  }
  const bool is_congested = session->outbox.num_messages() > limits_.congested_outbox_messages;
  return !has_budget || is_congested ? kReadPause : 0;
}

void GatewayCore::set_round_trip_time(uint32_t client, double round_trip_time) {
  if (ClientSession* session = sessions_.find(client)) session->round_trip_time = round_trip_time;
}

void GatewayCore::note_refusal(const std::string& address, const std::string& why) {
  if (audit_) audit_({"refused", 0, "", address, why});
}

void GatewayCore::close(uint32_t client, const Reason& reason, double now) {
  if (ClientSession* session = sessions_.find(client)) sessions_.close(*session, reason, now);
}

MessageBytes GatewayCore::next_message(uint32_t client, double now) {
  ClientSession* session = sessions_.find(client);
  if (session == nullptr) return nullptr;
  while (true) {
    MessageBytes message;
    switch (session->outbox.next()) {
      case Outbox::Next::kNothing:
        return nullptr;
      case Outbox::Next::kMessage:
        message = session->outbox.take_message();
        break;
      case Outbox::Next::kState:
        session->outbox.take_state();
        if (!session->is_closing) message = streams_.make_state_message(now);
        break;
      case Outbox::Next::kImage:
        session->outbox.take_image();
        if (!session->is_closing) message = streams_.make_image_message(*session, now);
        break;
    }
    // A state or image that was due may no longer exist.
    if (!message) continue;
    ++session->num_sent;
    return message;
  }
}

bool GatewayCore::is_image_next(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session != nullptr && session->outbox.next() == Outbox::Next::kImage;
}

bool GatewayCore::is_connected(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session != nullptr && session->is_connected;
}

bool GatewayCore::is_closing(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session == nullptr || session->is_closing;
}

// ---- Robot --------------------------------------------------------------------------------------

void GatewayCore::set_robot(const RobotSnapshot& robot, double now) {
  components_.handle_robot_state(now);
  streams_.set_robot(robot, now);
}

void GatewayCore::set_motion(const MotionSnapshot& motion, double now) {
  components_.handle_motion_state(motion.mode != Mode::kNoRobot, now);
  streams_.set_motion(motion);
}

void GatewayCore::add_image(CachedImage image, double now) {
  components_.handle_image(now);
  streams_.add_image(std::move(image), now);
}

void GatewayCore::handle_result(const CommandResult& result, double now) {
  commands_.handle_result(result, now);
  driving_.handle_result(result);
}

// ---- Time ---------------------------------------------------------------------------------------

void GatewayCore::step(double now) {
  driving_.step(now);
  commands_.step(now);
  step_components(now);
  sessions_.step(now);
  streams_.step(now);
}

void GatewayCore::step_components(double now) {
  components_.set_images_requested(!streams_.camera_requests(now).empty(), now);
  for (const ComponentMonitor::Change& change : components_.step(now)) {
    sessions_.broadcast(make_component_notice(change));
    streams_.handle_component_change();
    if (change.component != Component::kMotion || change.is_available) continue;
    // The motion that it executed has ended, and is not continued when it is available again.
    driving_.abandon_walk();
    commands_.fail_all(availability_reason(Component::kMotion, false), now);
  }
}

void GatewayCore::shut_down(double now) {
  for (const auto& [id, session] : sessions_.all()) {
    sessions_.close(*session, gateway_reason("gateway-stopping"), now);
  }
  driving_.end_walk(now);
}

}  // namespace nao::gateway
