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
                         std::function<void(const AuditEvent&)> audit,
                         std::optional<ExhibitionSetup> exhibition)
    : limits_(limits),
      audit_(audit),
      sessions_(limits, std::move(audit)),
      robots_(limits, sessions_, identity, std::move(robots)),
      match_(sessions_),
      requests_(limits, identity.server_version, identity.token, sessions_, robots_, match_) {
  sessions_.on_disconnect([this](const ClientSession& session, double now) {
    robots_.of(session).driving().handle_disconnect(session, now);
    if (exhibition_) exhibition_->handle_disconnect(session);
  });
  if (!exhibition) return;
  exhibition_ = std::make_unique<ExhibitionDesk>(std::move(*exhibition), sessions_, robots_.at(0));
  requests_.set_exhibition(exhibition_.get());
}

// ---- Connections --------------------------------------------------------------------------------

GatewayCore::Sender GatewayCore::find_sender(uint32_t connection) const {
  Sender sender;
  sender.connection = sessions_.find(connection);
  if (sender.connection == nullptr) return sender;
  sender.client = sessions_.client_of(*sender.connection);
  if (sender.connection->first != 0) {
    sender.part = Outbox::Part::kLong;
  } else if (sender.connection->second != 0) {
    sender.part = Outbox::Part::kShort;
  }
  return sender;
}

// Handles one message of a client; returns for how long, s, its connection shall not be read.
double GatewayCore::receive(uint32_t client, std::string_view message, double now) {
  const Sender sender = find_sender(client);
  ClientSession* session = sender.client;
  if (session == nullptr || session->is_closing || sender.connection->is_closing) return 0;
  session->last_request = now;

  naoremote::ServerMessage answer;
  naoremote::Response& response = *answer.mutable_response();
  naoremote::Request request;
  const bool is_request = message.size() <= kMaxRequestBytes &&
                          request.ParseFromArray(message.data(), static_cast<int>(message.size()));
  if (is_request) response.set_request_id(request.request_id());
  if (is_request && session->copies && !session->copies->take(request.request_id())) {
    // It has come over the other connection.
    return sender.connection->budget.take(now) ? 0 : kReadPause;
  }
  ++session->num_requests;
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
  if (is_answered) {
    const MessageBytes bytes = encode(answer);
    session->outbox.insert(position, bytes);
    ClientSession* second = sessions_.find(session->second);
    if (second != nullptr && session->is_lossy(now)) second->send(bytes);
  }
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

void GatewayCore::set_round_trip_time(uint32_t client, double round_trip_time, double least) {
  if (ClientSession* session = sessions_.find(client)) {
    session->round_trip_time = round_trip_time;
    session->least_round_trip = least;
  }
}

void GatewayCore::set_repeated_packets(uint32_t client, uint32_t number, double now) {
  if (ClientSession* session = sessions_.find(client)) session->note_repeated_packets(number, now);
}

bool GatewayCore::paces_image(uint32_t client) const {
  const Sender sender = find_sender(client);
  if (sender.client == nullptr || sender.part == Outbox::Part::kShort) return false;
  return sender.client->outbox.is_image_due() || sender.client->streams.image_pacer.is_under_way();
}

void GatewayCore::set_unacknowledged(uint32_t client, size_t bytes, double now) {
  const Sender sender = find_sender(client);
  // That of the connection which carries the images.
  if (sender.client == nullptr || sender.part == Outbox::Part::kShort) return;
  sender.client->streams.image_pacer.update(bytes, sender.connection->round_trip_time, now);
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
  const Sender sender = find_sender(client);
  if (sender.connection == nullptr) return nullptr;
  // Its own: copies of answers, and the notice with which it closes.
  if (sender.part == Outbox::Part::kLong && sender.connection->outbox.num_messages() > 0) {
    return sender.connection->outbox.take_message();
  }
  ClientSession* session = sender.client;
  if (session == nullptr || sender.connection->is_closing != session->is_closing) return nullptr;
  GatewayRobot& robot = robots_.of(*session);
  while (true) {
    MessageBytes message;
    bool is_image = false;
    switch (session->outbox.next(session->streams.image_pacer.may_send(), sender.part)) {
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
        is_image = true;
        if (!session->is_closing) message = robot.streams().make_image_message(*session, now);
        break;
    }
    // A state or image that was due may no longer exist.
    if (!message) continue;
    ++session->num_sent;
    if (!is_image && sender.part != Outbox::Part::kShort) {
      session->streams.image_pacer.note_other(message->size());
    }
    return message;
  }
}

bool GatewayCore::is_long_next(uint32_t client) const {
  const Sender sender = find_sender(client);
  if (sender.client == nullptr) return false;
  const Outbox::Next next =
      sender.client->outbox.next(sender.client->streams.image_pacer.may_send(), sender.part);
  return next == Outbox::Next::kImage || next == Outbox::Next::kAudio;
}

bool GatewayCore::is_connected(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session != nullptr && (session->is_connected || session->first != 0);
}

bool GatewayCore::is_closing(uint32_t client) const {
  const ClientSession* session = sessions_.find(client);
  return session == nullptr || session->is_closing;
}

// ---- Time ---------------------------------------------------------------------------------------

void GatewayCore::step(double now) {
  robots_.step(now);
  if (exhibition_) exhibition_->step(now);
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
