#include "phone-gateway/server/core/sessions.h"

#include <algorithm>
#include <utility>

#include "phone-gateway/server/core/client_name.h"

namespace nao::gateway {
namespace {

/** Bytes; see Connect. */
constexpr size_t kMaxJoinKey = 64;
/** Time between two checks of the limits, s. Chosen: a fiftieth of the timeouts; a client adds at
 * most ten messages to its outbox in it. */
constexpr double kCheckPeriod = 0.1;

void add(ClientCounters& sum, const ClientCounters& counters) {
  sum.num_requests += counters.num_requests;
  sum.num_refused += counters.num_refused;
  sum.num_sent += counters.num_sent;
  sum.num_skipped += counters.num_skipped;
}

}  // namespace

uint32_t Sessions::open(Endpoint endpoint, std::function<void()> wake, double now) {
  // Numbers are not used again: a late event of an old connection finds nothing.
  const uint32_t id = ++last_id_;
  sessions_.emplace_back(id,
                         std::make_unique<ClientSession>(id, std::move(endpoint), std::move(wake),
                                                         limits_.max_request_rate, now));
  return id;
}

ClientSession* Sessions::find(uint32_t id) const {
  const auto found = position_of(id);
  return found == sessions_.end() ? nullptr : found->second.get();
}

Sessions::List::const_iterator Sessions::position_of(uint32_t id) const {
  const auto found = std::ranges::lower_bound(sessions_, id, {}, &List::value_type::first);
  return found != sessions_.end() && found->first == id ? found : sessions_.end();
}

void Sessions::connect(ClientSession& session, const naoremote::Connect& request) {
  session.name = make_unique_name(request.client_name(), session.id);
  if (request.join_key().size() <= kMaxJoinKey) session.join_key = request.join_key();
  session.is_connected = true;
  session.is_muted = session.endpoint.is_watcher;
  audit("connected", session, clean_client_name(request.client_software()));
}

void Sessions::join(ClientSession& first, ClientSession& second, double now) {
  if (ClientSession* before = find(first.second)) {
    close(*before, gateway_reason("connection-replaced"), now);
    before->first = 0;
  }
  second.first = first.id;
  first.second = second.id;
  first.wake_second = second.wake_connection;
  if (!first.copies) first.copies = std::make_unique<RequestCopies>();
}

void Sessions::refuse(ClientSession& session, const naoremote::Connect& request,
                      const Reason& reason, double now) {
  session.name = clean_client_name(request.client_name());
  // The code without arguments, which may contain what the client sent: a client that varies its
  // request must not fill the log with lines that differ.
  audit("refused", session, reason.code);
  session.is_refused = true;
  close(session, reason, now);
}

// The connection is closed by the network once its last message is sent.
void Sessions::close(ClientSession& session, const Reason& reason, double now) {
  if (session.is_closing) return;
  naoremote::ServerMessage message;
  message.mutable_notice()->set_kind(naoremote::Notice::CLOSING);
  write_reason(reason, *message.mutable_notice());
  session.send(message);
  if (!session.is_connected && !session.is_refused && session.first == 0)
    audit("refused", session, reason.code);
  disconnect(session, reason.code, now);
  session.is_closing = true;
  session.wake();
  // A client's second connection does not outlive the first one.
  if (ClientSession* second = find(session.second)) close(*second, reason, now);
}

void Sessions::remove(uint32_t id, const std::string& why, double now) {
  ClientSession* session = find(id);
  if (session == nullptr) return;
  disconnect(*session, why, now);
  // Totals must not fall when a client leaves.
  add(past_counters_, session->calc_counters());
  if (ClientSession* second = find(session->second)) {
    close(*second, gateway_reason("connection-ended"), now);
  }
  // Images come over the first connection again.
  ClientSession* first = find(session->first);
  if (first != nullptr && first->second == id) {
    first->second = 0;
    first->wake_second = nullptr;
    first->streams.image_pacer = {};
  }
  sessions_.erase(position_of(id));
}

// Once for each client, whether it closes, is closed or is lost: control is released here.
void Sessions::disconnect(ClientSession& session, const std::string& why, double now) {
  if (!session.is_connected) return;
  session.is_connected = false;
  audit("disconnected", session, why);
  if (on_disconnect_) on_disconnect_(session, now);
}

void Sessions::broadcast(const naoremote::ServerMessage& message) const {
  // Encoded once for all clients.
  const MessageBytes bytes = encode(message);
  for (const auto& [id, session] : sessions_) {
    if (session->is_connected) session->send(bytes);
  }
}

void Sessions::step(double now) {
  if (now < next_check_) return;
  next_check_ = now + kCheckPeriod;
  for (const auto& [id, session] : sessions_) {
    if (session->is_closing) continue;
    const bool is_second = session->first != 0;
    if (!session->is_connected && !is_second &&
        now - session->opened_at > limits_.connect_timeout) {
      close(*session, gateway_reason("connect-timeout", {to_argument(limits_.connect_timeout)}),
            now);
    } else if (session->is_connected && now - session->last_request > limits_.silence_timeout) {
      close(*session, gateway_reason("silence-timeout", {to_argument(limits_.silence_timeout)}),
            now);
    } else if (session->outbox.num_messages() > limits_.max_outbox_messages) {
      close(*session,
            gateway_reason("messages-not-read", {std::to_string(limits_.max_outbox_messages)}),
            now);
    }
  }
}

int Sessions::num_connected() const {
  return static_cast<int>(std::count_if(sessions_.begin(), sessions_.end(), [](const auto& item) {
    return item.second->is_connected;
  }));
}

int Sessions::num_connected_from(const std::string& address) const {
  return static_cast<int>(std::count_if(sessions_.begin(), sessions_.end(), [&](const auto& item) {
    return item.second->is_connected && item.second->endpoint.address == address;
  }));
}

ClientCounters Sessions::calc_counters() const {
  ClientCounters sum = past_counters_;
  for (const auto& [id, session] : sessions_) add(sum, session->calc_counters());
  return sum;
}

void Sessions::audit(const std::string& event, const ClientSession& session,
                     const std::string& detail) {
  if (audit_) audit_({event, session.id, session.name, session.endpoint.address, detail});
}

std::string Sessions::make_unique_name(const std::string& requested, uint32_t id) const {
  std::string base = clean_client_name(requested);
  if (base.empty()) base = "phone " + std::to_string(id);
  const auto is_taken = [this](const std::string& name) {
    // The operator's name would otherwise let a phone look like the operator.
    return name == kOperatorName ||
           std::any_of(sessions_.begin(), sessions_.end(), [&](const auto& item) {
             return item.second->is_connected && item.second->name == name;
           });
  };
  std::string name = base;
  // Ends: every number is tried, and there are fewer clients than numbers.
  for (int i = 2; is_taken(name); ++i) name = base + " " + std::to_string(i);
  return name;
}

}  // namespace nao::gateway
