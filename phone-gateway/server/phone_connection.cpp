#include "phone-gateway/server/phone_connection.h"

#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

#include "common/wall_clock.h"

namespace nao {
namespace {

using boost::system::error_code;

/** How long a closing connection may take to send its last message and to see the other end close.
 */
constexpr std::chrono::seconds kClosingTime{2};
/** How long one message may take to leave: 64 kB at 2 kB/s. */
constexpr std::chrono::seconds kWriteTime{30};

}  // namespace

PhoneConnection::PhoneConnection(Hub& hub) : hub_(hub), pause_(hub.io), limit_(hub.io) {}

PhoneConnection::~PhoneConnection() {
  if (!hub_.is_ending) finish("connection lost");
}

void PhoneConnection::open(const Peer& peer) {
  const std::weak_ptr<PhoneConnection> weak = weak_from_this();
  is_waiting_ = true;
  const auto evict = [weak] {
    if (const auto self = weak.lock()) self->abort("too many connections");
  };
  if (hub_.waiting_room.enter(peer.address, evict, place_)) note_eviction(hub_, peer.address);
  const auto wake = [weak] {
    const auto self = weak.lock();
    if (!self || std::exchange(self->is_flush_due_, true)) return;
    asio::post(self->hub_.io, [self] {
      self->is_flush_due_ = false;
      self->flush_in_turn();
    });
  };
  id_ = hub_.core.open(peer, wake, monotonic_seconds());
}

bool PhoneConnection::receive(std::string_view message) {
  const double pause = hub_.core.receive(id_, message, monotonic_seconds());
  hub_.core.set_round_trip(id_, measure_round_trip(socket()));
  if (is_waiting_ && hub_.core.has_connected(id_)) leave_waiting_room();
  if (pause <= 0) return true;
  pause_.expires_after(std::chrono::microseconds(static_cast<int64_t>(pause * 1e6)));
  pause_.async_wait([self = shared_from_this()](const error_code& error) {
    if (!error) self->take_more();
  });
  return false;
}

void PhoneConnection::violate(const std::string& why) {
  ++hub_.counters.num_violations;
  hub_.core.violate(id_, why, monotonic_seconds());
}

void PhoneConnection::flush_in_turn() {
  if (is_writing_ || !hub_.core.is_image_next(id_)) {
    flush();
  } else if (!std::exchange(is_image_due_, true)) {
    hub_.images.add([weak = weak_from_this()] {
      const auto self = weak.lock();
      if (!self) return;
      self->is_image_due_ = false;
      self->flush();
    });
  }
}

void PhoneConnection::flush() {
  if (is_writing_ || is_finished_) return;
  const auto message = hub_.core.next_message(id_, monotonic_seconds());
  if (message) {
    is_writing_ = true;
    limit(is_closing() ? kClosingTime : kWriteTime);
    write(message);
  } else if (is_closing() && !std::exchange(is_shut_down_, true)) {
    limit(kClosingTime);
    shut_down();
  }
}

void PhoneConnection::on_written(bool has_failed) {
  is_writing_ = false;
  deadline_.reset();
  if (has_failed) {
    abort("closed by the client");
  } else {
    flush_in_turn();
  }
}

void PhoneConnection::limit(std::chrono::seconds time) {
  deadline_ = asio::steady_timer::clock_type::now() + time;
  if (!is_limit_waiting_ || limit_.expiry() > *deadline_) wait_for_limit();
}

void PhoneConnection::wait_for_limit() {
  is_limit_waiting_ = true;
  limit_.expires_at(*deadline_);
  limit_.async_wait([weak = weak_from_this()](const error_code& error) {
    const auto self = weak.lock();
    if (error || !self) return;
    self->is_limit_waiting_ = false;
    if (!self->deadline_) return;
    if (asio::steady_timer::clock_type::now() < *self->deadline_) {
      self->wait_for_limit();
    } else {
      self->abort("does not read what it is sent");
    }
  });
}

void PhoneConnection::abort(const std::string& why) {
  finish(why);
  pause_.cancel();
  limit_.cancel();
  close_socket();
}

void PhoneConnection::leave_waiting_room() {
  is_waiting_ = false;
  hub_.waiting_room.leave(place_);
}

void PhoneConnection::finish(const std::string& why) {
  if (std::exchange(is_finished_, true) || id_ == 0) return;
  if (is_waiting_) leave_waiting_room();
  hub_.core.closed(id_, why, monotonic_seconds());
}

}  // namespace nao
