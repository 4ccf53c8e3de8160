#include "phone-gateway/server/network/client_connection.h"

#include <utility>

#include "common/wall_clock.h"

namespace nao::gateway {
namespace {

using boost::system::error_code;

/** Time in which a closing connection must send its last message and the other end must close. The
 * gateway itself has 2 s to stop after SIGTERM. */
constexpr std::chrono::seconds kClosingTimeout{2};
/** Time in which one message must be sent: 64 kB at 2 kB/s. */
constexpr std::chrono::seconds kWriteTimeout{30};

}  // namespace

ClientConnection::ClientConnection(ConnectionContext& context)
    : context_(context), pause_(context.io), deadline_timer_(context.io) {}

// The end of the connection's last operation.
ClientConnection::~ClientConnection() {
  if (!context_.is_shutting_down) finish("connection lost");
}

// Registers the connection with the core. Until its Connect is accepted it counts as a handshake,
// of which an address has a limited number.
void ClientConnection::open(const Endpoint& endpoint) {
  const std::weak_ptr<ClientConnection> weak = weak_from_this();
  is_in_handshake_ = true;
  const auto evict = [weak] {
    if (const auto self = weak.lock()) self->abort("too many connections");
  };
  if (context_.handshakes.add(endpoint.address, evict, handshake_)) {
    note_eviction(context_, endpoint.address);
  }
  const auto wake = [weak] {
    const auto self = weak.lock();
    // One flush for all messages of an event. Later, as the core may call this while it goes
    // through its sessions.
    if (!self || std::exchange(self->is_flush_queued_, true)) return;
    self->context_.flush_queue.add(weak);
  };
  id_ = context_.core.open(endpoint, wake, monotonic_seconds());
}

bool ClientConnection::receive(std::string_view message) {
  const double pause = context_.core.receive(id_, message, monotonic_seconds());
  const LinkMeasurement link = measure();
  segment_bytes_ = link.segment_bytes;
  context_.core.set_round_trip_time(id_, link.mean, link.least);
  context_.core.set_repeated_packets(id_, link.num_repeated_packets, monotonic_seconds());
  if (is_in_handshake_ && context_.core.is_connected(id_)) end_handshake();
  if (pause <= 0) return true;
  // A client above its request rate is not read until its budget has recovered: TCP's flow control
  // then slows the sender.
  pause_.expires_after(std::chrono::microseconds(static_cast<int64_t>(pause * 1e6)));
  pause_.async_wait([self = shared_from_this()](const error_code& error) {
    if (!error) self->resume_reading();
  });
  return false;
}

void ClientConnection::reject(const Reason& reason) {
  ++context_.counters.num_violations;
  context_.core.close(id_, reason, monotonic_seconds());
}

void ClientConnection::flush() {
  is_flush_queued_ = false;
  send_messages(false);
}

void ClientConnection::send_long() {
  is_long_queued_ = false;
  send_messages(true);
}

void ClientConnection::send_messages(bool takes_long) {
  if (is_writing_ || is_finished_) return;
  const double now = monotonic_seconds();
  // It takes a system call.
  if (measures_image_) context_.core.set_unacknowledged(id_, unacknowledged(), now);
  Outgoing next;
  // One message is sent at a time; the next is made when this one has left.
  do {
    next = context_.core.next(id_, std::exchange(takes_long, false), now);
    measures_image_ = next.measures_image;
    if (next.message) send(std::move(next.message));
  } while (!is_writing_ && next.has_more);
  if (is_writing_) return;
  if (next.is_long_due) {
    // A client with large images must not delay the states of others.
    if (!std::exchange(is_long_queued_, true)) context_.image_queue.add(weak_from_this());
  } else if (next.is_closing && !std::exchange(is_shut_down_, true)) {
    // All messages are sent, the last of them CLOSING.
    set_deadline(kClosingTimeout);
    shut_down();
  }
}

void ClientConnection::send(MessageBytes message) {
  is_writing_ = !write(std::move(message));
  if (is_writing_) set_deadline(is_closing() ? kClosingTimeout : kWriteTimeout);
}

void ClientConnection::on_written(bool has_failed) {
  is_writing_ = false;
  deadline_.reset();
  if (has_failed) {
    abort("closed by the client");
  } else {
    send_messages(false);
  }
}

void ClientConnection::set_deadline(std::chrono::seconds time) {
  // The timer is not restarted for each message, which would cost two system calls: when it expires
  // early, it waits again for the deadline of that moment.
  deadline_ = asio::steady_timer::clock_type::now() + time;
  if (!is_deadline_timer_running_ || deadline_timer_.expiry() > *deadline_) wait_for_deadline();
}

void ClientConnection::wait_for_deadline() {
  is_deadline_timer_running_ = true;
  deadline_timer_.expires_at(*deadline_);
  deadline_timer_.async_wait([weak = weak_from_this()](const error_code& error) {
    const auto self = weak.lock();
    if (error || !self) return;
    self->is_deadline_timer_running_ = false;
    if (!self->deadline_) return;
    if (asio::steady_timer::clock_type::now() < *self->deadline_) {
      self->wait_for_deadline();
    } else {
      self->abort("does not read its messages");
    }
  });
}

// At once, without a last message: the other end does not read or has gone.
void ClientConnection::abort(const std::string& why) {
  finish(why);
  pause_.cancel();
  deadline_timer_.cancel();
  close_socket();
}

void ClientConnection::end_handshake() {
  is_in_handshake_ = false;
  context_.handshakes.remove(handshake_);
}

void ClientConnection::finish(const std::string& why) {
  // Several failures of one connection are reported to the core once.
  if (std::exchange(is_finished_, true) || id_ == 0) return;
  if (is_in_handshake_) end_handshake();
  context_.core.closed(id_, why, monotonic_seconds());
}

}  // namespace nao::gateway
