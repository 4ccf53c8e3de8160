// Connections, robot and time; the use cases are in gateway_core_requests.cpp.
#include "phone-gateway/server/gateway_core.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/client_name.h"

namespace nao {
namespace {

// How long a connection pauses when its client is too fast or does not read.
constexpr double kPause = 0.02;
constexpr double kStaleStatePeriod = 1.0;
constexpr double kRepeatedReasonTime = 2.0;
// A polling client's images, 1/s: enough for ten polls a second to find a new one each.
constexpr double kPolledImageRate = 15;
constexpr double kImageLife = 10;

naoremote::Notice::Status to_notice_status(CommandStatus status) {
  switch (status) {
    case CommandStatus::kAccepted:
      return naoremote::Notice::ACCEPTED;
    case CommandStatus::kRefused:
      return naoremote::Notice::REFUSED;
    case CommandStatus::kDone:
      return naoremote::Notice::DONE;
    case CommandStatus::kInterrupted:
      return naoremote::Notice::INTERRUPTED;
    case CommandStatus::kFailed:
      return naoremote::Notice::FAILED;
  }
  return naoremote::Notice::FAILED;
}

naoremote::Notice::Component to_component(PartMonitor::Part part) {
  switch (part) {
    case PartMonitor::Part::kMotion:
      return naoremote::Notice::MOTION;
    case PartMonitor::Part::kRobot:
      return naoremote::Notice::ROBOT;
    case PartMonitor::Part::kCamera:
      return naoremote::Notice::CAMERA;
  }
  return naoremote::Notice::MOTION;
}

void add_counts(GatewayCounters& counters, const PhoneSession& session) {
  counters.num_requests += session.num_received;
  counters.num_refused += session.num_refused;
  counters.num_sent += session.num_sent;
  counters.num_skipped += session.outbox.num_skipped();
}

}  // namespace

GatewayCore::GatewayCore(PhoneRobot robot, const GatewayLimits& limits, GatewayIdentity identity,
                         GatewayOutputs outputs)
    : robot_(std::move(robot)),
      limits_(limits),
      identity_(std::move(identity)),
      outputs_(std::move(outputs)),
      next_command_id_(identity_.first_command_id),
      parts_(limits),
      lease_(limits.lease_idle_time),
      walk_(limits),
      commands_(limits) {}

// ---- Connections --------------------------------------------------------------------------------

PhoneSession* GatewayCore::find(uint32_t client) const {
  const auto found = sessions_.find(client);
  return found == sessions_.end() ? nullptr : found->second.get();
}

uint32_t GatewayCore::open(Peer peer, std::function<void()> wake, double now) {
  const uint32_t id = ++last_client_id_;
  sessions_[id] =
      std::make_unique<PhoneSession>(id, std::move(peer), std::move(wake), limits_, now);
  return id;
}

double GatewayCore::receive(uint32_t client, std::string_view message, double now) {
  PhoneSession* session = find(client);
  if (session == nullptr || session->is_closing) return 0;
  session->last_heard = now;
  ++session->num_received;

  naoremote::ServerMessage answer_message;
  Response& response = *answer_message.mutable_response();
  Request request;
  const bool is_request = message.size() <= kMaxRequestBytes &&
                          request.ParseFromArray(message.data(), static_cast<int>(message.size()));
  if (is_request) response.set_request_id(request.request_id());
  const bool has_budget = session->budget.take(now);
  if (!is_request) {
    response.set_error(naoremote::INVALID_REQUEST);
    response.set_message("These bytes are no Request.");
  } else if (!has_budget && !request.has_stop()) {
    response.set_error(naoremote::TOO_MANY_REQUESTS);
    response.set_message("More than 100 requests in a second.");
  } else {
    answer(*session, request, response, now);
  }
  if (response.error() != naoremote::OK) ++session->num_refused;
  push(*session, answer_message);
  follow_up(*session, now);
  if (!is_request && ++session->num_malformed > limits_.max_malformed_requests) {
    close_session(*session, "Too many messages that are no Request.", now);
  }
  const bool is_congested = session->outbox.num_messages() > limits_.congested_outbox_messages;
  return !has_budget || is_congested ? kPause : 0;
}

void GatewayCore::follow_up(PhoneSession& session, double now) {
  if (std::exchange(session.tells_missing_parts, false)) {
    for (const auto part :
         {PartMonitor::Part::kMotion, PartMonitor::Part::kRobot, PartMonitor::Part::kCamera}) {
      if (!parts_.is_available(part)) tell_part(&session, {part, false});
    }
  }
  if (!session.tells_control_changed.empty()) {
    tell_control_changed(std::exchange(session.tells_control_changed, ""));
  }
  if (!session.closes_because.empty()) close_session(session, session.closes_because, now);
}

void GatewayCore::set_round_trip(uint32_t client, double round_trip) {
  if (PhoneSession* session = find(client)) session->round_trip = round_trip;
}

void GatewayCore::note_refusal(const std::string& address, const std::string& why) {
  if (outputs_.audit) outputs_.audit({"refused", 0, "", address, why});
}

void GatewayCore::violate(uint32_t client, const std::string& why, double now) {
  if (PhoneSession* session = find(client)) close_session(*session, why, now);
}

void GatewayCore::closed(uint32_t client, const std::string& why, double now) {
  PhoneSession* session = find(client);
  if (session == nullptr) return;
  leave(*session, why, now);
  add_counts(past_counters_, *session);
  sessions_.erase(client);
}

GatewayCounters GatewayCore::counters() const {
  GatewayCounters counters = past_counters_;
  for (const auto& [id, session] : sessions_) add_counts(counters, *session);
  return counters;
}

MessageBytes GatewayCore::next_message(uint32_t client, double now) {
  PhoneSession* session = find(client);
  if (session == nullptr) return nullptr;
  while (true) {
    switch (session->outbox.next()) {
      case Outbox::Next::kNothing:
        return nullptr;
      case Outbox::Next::kMessage:
        ++session->num_sent;
        return session->outbox.take_message();
      case Outbox::Next::kState:
        session->outbox.take_state();
        if (!mirror_.has_state() || session->is_closing) continue;
        ++session->num_sent;
        return encode_state(now);
      case Outbox::Next::kImage: {
        session->outbox.take_image();
        StoredImage* image = images_.find(session->subscription.image, session->last_image);
        if (image == nullptr || session->is_closing) continue;
        session->last_image = image->number;
        ++session->num_sent;
        return encode_image(*image, now);
      }
    }
  }
}

MessageBytes GatewayCore::encode_state(double now) {
  return state_encoding_.get(now, [&] {
    naoremote::ServerMessage message;
    mirror_.write(*message.mutable_state(), parts_.is_available(PartMonitor::Part::kRobot), now);
    return message;
  });
}

MessageBytes GatewayCore::encode_image(StoredImage& stored, double now) {
  return stored.encoding.get(now, [&] {
    naoremote::ServerMessage message;
    write_image(stored, *message.mutable_image(), now);
    return message;
  });
}

void GatewayCore::write_image(const StoredImage& stored, naoremote::Image& image,
                              double now) const {
  image.set_utime(static_cast<uint64_t>(stored.utime));
  // From the moment that it shows, by the robot's clock, where that makes sense: robot and camera
  // may have been restarted apart.
  const double since_arrival = now - stored.time;
  const double since_shown =
      static_cast<double>(mirror_.calc_robot_utime(now) - stored.utime) * 1e-6;
  const bool is_plausible = since_shown >= since_arrival && since_shown < since_arrival + 2;
  image.set_age_ms((is_plausible ? since_shown : since_arrival) * 1e3);
  image.set_camera(stored.camera);
  image.set_width(stored.width);
  image.set_height(stored.height);
  image.set_jpeg(stored.jpeg);
}

bool GatewayCore::has_connected(uint32_t client) const {
  const PhoneSession* session = find(client);
  return session != nullptr && session->is_connected;
}

bool GatewayCore::is_image_next(uint32_t client) const {
  const PhoneSession* session = find(client);
  return session != nullptr && session->outbox.next() == Outbox::Next::kImage;
}

bool GatewayCore::is_closing(uint32_t client) const {
  const PhoneSession* session = find(client);
  return session == nullptr || session->is_closing;
}

void GatewayCore::close_session(PhoneSession& session, const std::string& why, double now) {
  if (session.is_closing) return;
  naoremote::ServerMessage message;
  message.mutable_notice()->set_kind(naoremote::Notice::CLOSING);
  message.mutable_notice()->set_message(why);
  push(session, message);
  if (!session.is_connected && !session.is_refused) audit("refused", session, why);
  leave(session, why, now);
  session.is_closing = true;
  session.wake();
}

void GatewayCore::leave(PhoneSession& session, const std::string& why, double now) {
  if (!session.is_connected) return;
  session.is_connected = false;
  audit("disconnected", session, why);
  if (commands_.forget_client(session.id)) {
    send_event(0, 0, number(session, StopMotion{}), now);
  }
  if (lease_.driver() != session.id) return;
  end_walk(now);
  lease_.release(session.id);
  tell_control_changed(session.name + " is gone; nobody drives.");
}

// ---- Sending ------------------------------------------------------------------------------------

void GatewayCore::push(PhoneSession& session, const naoremote::ServerMessage& message) {
  push(session, encode(message));
}

void GatewayCore::push(PhoneSession& session, MessageBytes message) {
  if (session.is_closing) return;
  session.outbox.push(std::move(message));
  session.wake();
}

void GatewayCore::broadcast(const naoremote::ServerMessage& message) {
  const MessageBytes bytes = encode(message);
  for (const auto& [id, session] : sessions_) {
    if (session->is_connected) push(*session, bytes);
  }
}

void GatewayCore::tell_outcome(const CommandTracker::Entry& entry, CommandStatus status,
                               const std::string& reason, double now) {
  PhoneSession* session = find(entry.client);
  if (session == nullptr) return;
  std::string text = reason;
  if (text.empty() && status == CommandStatus::kDone) {
    text = describe(entry.command.command) + ": done.";
  }
  const bool is_walk = std::holds_alternative<WalkVelocity>(entry.command.command);
  if (is_walk && status == CommandStatus::kRefused) {
    // A joystick that stays held asks again and again, and is refused each time.
    const bool is_repeated =
        text == last_walk_reason_ && now - last_walk_reason_time_ < kRepeatedReasonTime;
    if (is_repeated) return;
    last_walk_reason_ = text;
    last_walk_reason_time_ = now;
  }
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::COMMAND_RESULT);
  notice.set_request_id(entry.request_id);
  notice.set_status(to_notice_status(status));
  notice.set_message(text);
  push(*session, message);
}

void GatewayCore::tell_control_changed(const std::string& text) {
  for (const auto& [id, session] : sessions_) {
    if (!session->is_connected) continue;
    naoremote::ServerMessage message;
    naoremote::Notice& notice = *message.mutable_notice();
    notice.set_kind(naoremote::Notice::CONTROL_CHANGED);
    notice.set_message(text);
    *notice.mutable_control() = control_for(*session);
    push(*session, message);
  }
}

void GatewayCore::tell_part(PhoneSession* session, const PartMonitor::Change& change) {
  naoremote::ServerMessage message;
  naoremote::Notice& notice = *message.mutable_notice();
  notice.set_kind(naoremote::Notice::COMPONENT_CHANGED);
  notice.set_message(describe(change));
  notice.set_component(to_component(change.part));
  notice.set_is_available(change.is_available);
  if (session != nullptr) {
    push(*session, message);
  } else {
    broadcast(message);
  }
}

std::string GatewayCore::driver_name() const {
  if (lease_.driver() == kOperatorId) return kOperatorName;
  const PhoneSession* session = find(lease_.driver());
  return session == nullptr ? "" : session->name;
}

naoremote::Control GatewayCore::control_for(const PhoneSession& session) const {
  naoremote::Control control;
  control.set_driver_id(lease_.driver());
  control.set_driver_name(driver_name());
  control.set_is_mine(lease_.driver() == session.id);
  return control;
}

// ---- Robot --------------------------------------------------------------------------------------

void GatewayCore::set_robot(const RobotSnapshot& robot, double now) {
  mirror_.set(robot, now);
  state_encoding_.reset();
  parts_.heard_robot(now);
  for (const auto& [id, session] : sessions_) {
    if (!session->is_connected || !session->state_pacer.allow(now)) continue;
    session->outbox.want_state();
    session->wake();
  }
}

void GatewayCore::set_motion(const MotionSnapshot& motion, double now) {
  mirror_.set(motion);
  state_encoding_.reset();
  parts_.heard_motion(motion.mode != Mode::kNoRobot, now);
}

void GatewayCore::add_image(StoredImage image, double now) {
  parts_.heard_image(now);
  const ImageSelection shown{image.camera, image.width, 0};
  images_.put(std::move(image), now);
  for (const auto& [id, session] : sessions_) {
    if (!session->is_connected || !session->subscription.image.shows_same(shown)) continue;
    if (!session->image_pacer.allow(now)) continue;
    session->outbox.want_image();
    session->wake();
  }
}

void GatewayCore::add_result(const CommandResult& result, double now) {
  if (const auto entry = commands_.answer(result.source, result.command_id, result.status)) {
    tell_outcome(*entry, result.status, result.reason, now);
  }
  const bool is_final = result.status != CommandStatus::kAccepted;
  if (is_final && walk_.is_walking() && result.command_id == walk_.command_id() &&
      result.source == walk_.source()) {
    // The next WalkTurn begins a new walk, under a new number.
    walk_.abandon();
  }
}

std::vector<CameraRequest> GatewayCore::camera_requests(double now) const {
  std::vector<CameraRequest> wishes;
  const auto add = [&wishes](const ImageSelection& image, double rate) {
    for (CameraRequest& wish : wishes) {
      if (!wish.image.shows_same(image)) continue;
      wish.rate = std::max(wish.rate, rate);
      wish.image.quality = std::max(wish.image.quality, image.quality);
      return;
    }
    wishes.push_back({image, rate});
  };
  for (const auto& [id, session] : sessions_) {
    if (!session->is_connected) continue;
    const Subscription& subscription = session->subscription;
    if (subscription.image_rate > 0) add(subscription.image, subscription.image_rate);
    if (now - session->last_poll < limits_.poll_watch_time) {
      add(session->polled_image, kPolledImageRate);
    }
  }
  return wishes;
}

// ---- Time ---------------------------------------------------------------------------------------

void GatewayCore::step(double now) {
  step_commands(now);
  step_parts(now);
  step_sessions(now);
  images_.drop_before(now - kImageLife);
}

void GatewayCore::step_commands(double now) {
  send_walk(now);
  for (const NumberedCommand& command : commands_.due(now)) outputs_.send(command);
  for (const CommandTracker::Entry& entry : commands_.take_unanswered(now)) {
    tell_outcome(entry, CommandStatus::kFailed, "The robot's motion program does not answer.", now);
  }
}

void GatewayCore::step_parts(double now) {
  parts_.set_watched(!camera_requests(now).empty(), now);
  for (const PartMonitor::Change& change : parts_.step(now)) {
    tell_part(nullptr, change);
    state_encoding_.reset();
    if (change.part != PartMonitor::Part::kMotion || change.is_available) continue;
    // What it was doing has ended with it, and is not taken up again when it is back.
    walk_.abandon();
    for (const CommandTracker::Entry& entry : commands_.take_all()) {
      tell_outcome(entry, CommandStatus::kFailed, describe(change), now);
    }
  }
  if (parts_.is_available(PartMonitor::Part::kRobot) || now < next_stale_state_) return;
  next_stale_state_ = now + kStaleStatePeriod;
  for (const auto& [id, session] : sessions_) {
    if (!session->is_connected || session->subscription.state_rate <= 0) continue;
    session->outbox.want_state();
    session->wake();
  }
}

void GatewayCore::step_sessions(double now) {
  for (const auto& [id, session] : sessions_) {
    if (session->is_closing) continue;
    if (!session->is_connected && now - session->opened_at > limits_.handshake_time) {
      close_session(*session, "No Connect within 5 s.", now);
    } else if (session->is_connected && now - session->last_heard > limits_.silence_time) {
      close_session(*session, "No sign of life for 5 s.", now);
    } else if (session->outbox.num_messages() > limits_.max_outbox_messages) {
      close_session(*session, "Too many messages were not read.", now);
    }
  }
}

void GatewayCore::shut_down(double now) {
  for (const auto& [id, session] : sessions_) {
    close_session(*session, "The gateway is being shut down.", now);
  }
  end_walk(now);
}

// ---- Commands -----------------------------------------------------------------------------------

NumberedCommand GatewayCore::number(const PhoneSession& session, MotionCommand command) {
  return {identity_.source + "." + std::to_string(session.id), next_command_id_++,
          std::move(command)};
}

void GatewayCore::send_event(uint32_t client, uint32_t request_id, const NumberedCommand& command,
                             double now) {
  for (const CommandTracker::Entry& entry : commands_.supersede(command.command)) {
    tell_outcome(entry, CommandStatus::kInterrupted, "Another command came before it was heard.",
                 now);
  }
  commands_.add(client, request_id, command, now);
  outputs_.send(command);
}

void GatewayCore::send_walk(double now) {
  while (const auto command = walk_.step(now)) outputs_.send(*command);
}

void GatewayCore::end_walk(double now) {
  walk_.end(now);
  send_walk(now);
}

void GatewayCore::audit(const std::string& event, const PhoneSession& session,
                        const std::string& detail) {
  if (outputs_.audit) {
    outputs_.audit({event, session.id, session.name, session.peer.address, detail});
  }
}

}  // namespace nao
