#include "phone-gateway/server/core/gateway_core.h"

#include <algorithm>
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

// The message is made at this moment: states and images are encoded when they can be sent, and so
// are never old.
Outgoing GatewayCore::next(uint32_t client, bool takes_long, double now) {
  const Sender sender = find_sender(client);
  Outgoing next;
  next.is_closing = sender.connection == nullptr || sender.connection->is_closing;
  if (sender.connection == nullptr) return next;
  // Its own: copies of answers, and the notice with which it closes.
  if (sender.part == Outbox::Part::kLong && sender.connection->outbox.num_messages() > 0) {
    next.message = sender.connection->outbox.take_message();
    next.has_more = true;
    return next;
  }
  ClientSession* session = sender.client;
  if (session == nullptr || sender.connection->is_closing != session->is_closing) return next;
  Outbox& outbox = session->outbox;
  ImagePacer& pacer = session->streams.image_pacer;
  const auto is_long = [](Outbox::Next first) {
    return first == Outbox::Next::kImage || first == Outbox::Next::kAudio;
  };
  Outbox::Next first = outbox.next(pacer.may_send(), sender.part);
  while (first != Outbox::Next::kNothing && !next.message) {
    next.is_long_due = is_long(first) && !takes_long;
    if (next.is_long_due) break;
    next.message = take(*session, first, now);
    if (next.message && first == Outbox::Next::kImage) {
      if (std::ranges::find(receiving_, session->id) == receiving_.end()) {
        receiving_.push_back(session->id);
      }
    } else if (next.message && sender.part != Outbox::Part::kShort) {
      pacer.note_other(next.message->size());
    }
    first = outbox.next(pacer.may_send(), sender.part);
  }
  if (next.message) ++session->num_sent;
  next.has_more = next.message && first != Outbox::Next::kNothing;
  next.measures_image = sender.part != Outbox::Part::kShort && pacer.is_under_way();
  return next;
}

MessageBytes GatewayCore::take(ClientSession& session, Outbox::Next first, double now) {
  GatewayRobot& robot = robots_.of(session);
  Outbox& outbox = session.outbox;
  // Of a client whose connection closes only what it was told is sent.
  const bool is_closing = session.is_closing;
  switch (first) {
    case Outbox::Next::kNothing:
      return nullptr;
    case Outbox::Next::kMessage:
      return outbox.take_message();
    case Outbox::Next::kPlayState:
      outbox.take_play_state();
      return is_closing ? nullptr : robot.perception().make_play_state_message();
    case Outbox::Next::kVision:
      outbox.take_vision();
      return is_closing ? nullptr : robot.perception().make_vision_message();
    case Outbox::Next::kState:
      outbox.take_state();
      return is_closing ? nullptr : robot.streams().make_state_message(now);
    case Outbox::Next::kAudio: {
      MessageBytes piece = outbox.take_audio();
      return is_closing ? nullptr : piece;
    }
    case Outbox::Next::kImage:
      outbox.take_image();
      return is_closing ? nullptr : robot.streams().make_image_message(session, now);
  }
  return nullptr;
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
  std::erase_if(receiving_, [&](uint32_t client) {
    const ClientSession* session = sessions_.find(client);
    if (session == nullptr || !session->streams.image_pacer.is_under_way()) return true;
    if (session->streams.image_pacer.is_to_be_measured(now)) session->wake();
    return false;
  });
}

void GatewayCore::shut_down(double now) {
  // Clients get a notice before the connections end, and the robots stop.
  for (const auto& [id, session] : sessions_.all()) {
    sessions_.close(*session, gateway_reason("gateway-stopping"), now);
  }
  for (size_t i = 0; i < robots_.size(); ++i) robots_.at(i).driving().end_motion(now);
}

}  // namespace nao::gateway
