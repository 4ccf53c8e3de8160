#include "phone-gateway/server/core/gateway_core.h"

#include <utility>

#include "phone-gateway/protocol/framing.h"

namespace nao::gateway {
namespace {

/** Pause of a connection whose client sends too fast or does not read, s: one step of the gateway.
 */
constexpr double kReadPause = 0.02;

}  // namespace

GatewayCore::GatewayCore(std::vector<RobotSetup> robots, const GatewayLimits& limits,
                         const GatewayIdentity& identity,
                         std::function<void(const AuditEvent&)> audit)
    : limits_(limits),
      audit_(audit),
      sessions_(limits, std::move(audit)),
      robots_(limits, sessions_, identity, std::move(robots)),
      match_(sessions_),
      requests_(limits, identity.server_version, identity.token, sessions_, robots_, match_) {
  sessions_.on_disconnect([this](const ClientSession& session, double now) {
    robots_.of(session).driving().handle_disconnect(session, now);
  });
}

// ---- Connections --------------------------------------------------------------------------------

// Handles one message of a client; returns for how long, s, its connection shall not be read.
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
  // A stop is carried out even above the request rate.
  const bool has_budget = session->budget.take(now);
  // A request may cause notices to the same client. The answer goes before them.
  const size_t position = session->outbox.num_messages();
  bool is_answered = true;
  if (!is_request) {
    response.set_error(naoremote::INVALID_REQUEST);
    write_reason(gateway_reason("not-a-request"), response);
  } else if (!has_budget && !request.has_stop()) {
    response.set_error(naoremote::TOO_MANY_REQUESTS);
    write_reason(gateway_reason("too-many-requests", {to_argument(limits_.max_request_rate)}),
                 response);
  } else {
    is_answered = requests_.handle(*session, request, response, now);
  }
  if (response.error() != naoremote::OK) ++session->num_refused;
  if (is_answered) session->outbox.insert(position, encode(answer));
  session->wake();
  // Garbage now and then is answered; a client that sends nothing else is closed.
  if (!is_request && ++session->num_malformed > limits_.max_malformed_requests) {
    sessions_.close(*session,
                    gateway_reason("too-many-malformed-requests",
                                   {std::to_string(limits_.max_malformed_requests)}),
                    now);
  }
  // A client that does not read its messages is not read either.
  const bool is_congested = session->outbox.num_messages() > limits_.congested_outbox_messages;
  return !has_budget || is_congested ? kReadPause : 0;
}

void GatewayCore::set_round_trip_time(uint32_t client, double round_trip_time) {
  if (ClientSession* session = sessions_.find(client)) session->round_trip_time = round_trip_time;
}

void GatewayCore::set_unacknowledged(uint32_t client, size_t bytes, double now) {
  if (ClientSession* session = sessions_.find(client)) {
    session->streams.image_pacer.update(bytes, session->round_trip_time, now);
  }
}

void GatewayCore::note_refusal(const std::string& address, const std::string& why) {
  if (audit_) audit_({"refused", 0, "", address, why});
}

void GatewayCore::close(uint32_t client, const Reason& reason, double now) {
  if (ClientSession* session = sessions_.find(client)) sessions_.close(*session, reason, now);
}

// The next message for the client's connection, made at this moment: states and images are encoded
// when they can be sent, and so are never old.
MessageBytes GatewayCore::next_message(uint32_t client, double now) {
  ClientSession* session = sessions_.find(client);
  if (session == nullptr) return nullptr;
  GatewayRobot& robot = robots_.of(*session);
  while (true) {
    MessageBytes message;
    switch (session->outbox.next(session->streams.image_pacer.may_send())) {
      case Outbox::Next::kNothing:
        return nullptr;
      case Outbox::Next::kMessage:
        message = session->outbox.take_message();
        break;
      case Outbox::Next::kPlayState:
        session->outbox.take_play_state();
        if (!session->is_closing) message = robot.perception().make_play_state_message();
        break;
      case Outbox::Next::kVision:
        session->outbox.take_vision();
        if (!session->is_closing) message = robot.perception().make_vision_message();
        break;
      case Outbox::Next::kState:
        session->outbox.take_state();
        if (!session->is_closing) message = robot.streams().make_state_message(now);
        break;
      case Outbox::Next::kAudio:
        message = session->outbox.take_audio();
        if (session->is_closing) message.reset();
        break;
      case Outbox::Next::kImage:
        session->outbox.take_image();
        if (!session->is_closing) message = robot.streams().make_image_message(*session, now);
        break;
    }
    // A state or image that was due may no longer exist.
    if (!message) continue;
    ++session->num_sent;
    return message;
  }
}

bool GatewayCore::is_long_next(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  if (session == nullptr) return false;
  const Outbox::Next next = session->outbox.next(session->streams.image_pacer.may_send());
  return next == Outbox::Next::kImage || next == Outbox::Next::kAudio;
}

bool GatewayCore::is_connected(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session != nullptr && session->is_connected;
}

bool GatewayCore::is_closing(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session == nullptr || session->is_closing;
}

// ---- Time ---------------------------------------------------------------------------------------

void GatewayCore::step(double now) {
  robots_.step(now);
  match_.step(now);
  sessions_.step(now);
  // Whether the last image has arrived: its time is measured, and the next one may wait for it.
  for (const auto& [id, session] : sessions_.all()) {
    if (session->streams.image_pacer.is_under_way()) session->wake();
  }
}

void GatewayCore::shut_down(double now) {
  // Clients get a notice before the connections end, and the robots stop.
  for (const auto& [id, session] : sessions_.all()) {
    sessions_.close(*session, gateway_reason("gateway-stopping"), now);
  }
  for (size_t i = 0; i < robots_.size(); ++i) robots_.at(i).driving().end_motion(now);
}

}  // namespace nao::gateway
