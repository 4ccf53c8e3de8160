#include "common/bus.h"

#include <poll.h>

#include <cmath>

#include "common/logger.h"
#include "common/wall_clock.h"

namespace nao {
namespace {

/** Messages that are taken from the kernel before the first of them is handled. Chosen: more than
 * arrive between two ticks. */
constexpr size_t kMostWaiting = 64;

/** @return The subscription, which LCM refuses by nullptr. @throws BusError  then. */
lcm_subscription_t* require_subscription(lcm_subscription_t* subscription,
                                         const std::string& pattern, const std::string& url) {
  if (subscription != nullptr) return subscription;
  throw BusError("cannot receive " + pattern + " from the message bus " + url +
                 ": a firewall drops its multicast messages, or the pattern of the channels is not "
                 "a regular expression; allow UDP to its address and port; try: nao bus");
}

}  // namespace

Bus::Bus(const std::string& url) : url_(url), lcm_(url) {
  if (!lcm_.good()) {
    throw BusError("cannot open the message bus " + url +
                   ": the address is wrong, or this machine has no multicast route; "
                   "try: ip link set lo multicast on; ip route add 239.255.76.0/24 dev lo");
  }
}

// All messages that have arrived, without waiting; handlers run here.
void Bus::handle() {
  open_socket();
  const BusSocket::Waiting waiting = socket_.waiting();
  bool may_have_more = waiting.is_here;
  while (may_have_more || !waiting_.empty()) {
    if (waiting_.empty()) may_have_more = take_in();
    if (!waiting_.empty()) handle_waiting();
  }
  while (waiting.is_at_lcm && handle_lcm()) {
  }
}

bool Bus::handle_for(double timeout) {
  const double end = monotonic_seconds() + timeout;
  while (!handle_one()) {
    const double left = end - monotonic_seconds();
    pollfd polled{descriptor(), POLLIN, 0};
    // What has arrived may be a fragment only.
    if (left <= 0 || poll(&polled, 1, static_cast<int>(std::ceil(left * 1e3))) < 0) return false;
  }
  return true;
}

// Of a message for several receivers each has a copy, which waits by the rule of its queue.
// False: the kernel has no more.
bool Bus::take_in() {
  while (waiting_.size() < kMostWaiting) {
    const auto message = socket_.receive();
    if (!message) return false;
    for (const auto& receiver : receivers_) {
      if (receiver->channel.empty() || receiver->channel != message->channel) continue;
      if (receiver->queue_capacity == 1) {
        std::erase_if(waiting_,
                      [&](const Waiting& each) { return each.receiver == receiver.get(); });
      }
      Waiting& next = waiting_.emplace_back(
          Waiting{receiver.get(), std::exchange(unused_, {}), nao::wall_utime()});
      next.bytes.assign(message->bytes.begin(), message->bytes.end());
    }
  }
  return true;
}

void Bus::handle_waiting() {
  // The handler may receive others.
  Waiting next = std::move(waiting_.front());
  waiting_.pop_front();
  next.receiver->receive({next.receiver->channel, next.bytes, next.wall_utime});
  unused_ = std::move(next.bytes);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool Bus::handle_lcm() {
  const bool has_handled = lcm_.handleTimeout(0) > 0;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return has_handled;
}

bool Bus::handle_one() {
  open_socket();
  if (waiting_.empty()) take_in();
  if (waiting_.empty()) return handle_lcm();
  handle_waiting();
  return true;
}

void Bus::count_sent(const std::string& channel, bool sent) {
  if (sent) {
    ++counters_.num_out;
  } else {
    drop(channel, "the operating system rejected the transmission");
  }
}

void Bus::drop(const std::string& channel, const std::string& why) {
  ++counters_.num_dropped;
  if (const auto num_suppressed = warnings_.allow(monotonic_seconds())) {
    logger::warn("{}: message dropped: {} ({} similar warnings suppressed)", channel, why,
                 *num_suppressed);
  }
}

void Bus::publish_raw(const std::string& channel, std::span<const uint8_t> message) {
  count_sent(channel,
             lcm_.publish(channel, message.data(), static_cast<unsigned>(message.size())) == 0);
}

void Bus::subscribe_raw(const std::string& pattern, std::function<void(const RawMessage&)> handler,
                        int queue_capacity) {
  add_receiver(pattern, "", queue_capacity, std::move(handler));
  socket_.leave_to_lcm();
}

void Bus::add_receiver(const std::string& pattern, const std::string& channel, int queue_capacity,
                       std::function<void(const RawMessage&)> handler) {
  open_socket();
  const auto& receiver = receivers_.emplace_back(
      std::make_unique<Receiver>(Receiver{this, channel, queue_capacity, std::move(handler)}));
  const auto receive = [](const lcm_recv_buf_t* buffer, const char* channel, void* user) {
    const auto* data = static_cast<const uint8_t*>(buffer->data);
    static_cast<Receiver*>(user)->receive({channel, {data, buffer->data_size}, buffer->recv_utime});
  };
  lcm_subscription_set_queue_capacity(
      require_subscription(
          lcm_subscribe(lcm_.getUnderlyingLCM(), pattern.c_str(), receive, receiver.get()), pattern,
          url_),
      queue_capacity);
}

// Called by LCM's C code, which no exception may cross.
void Bus::Receiver::receive(const RawMessage& message) const {
  // LCM's own message, sent whenever a program opens the bus.
  if (message.channel == "LCM_SELF_TEST") return;
  // The program ends: a handler of the same message has failed.
  if (bus->failure_) return;
  ++bus->counters_.num_in;
  try {
    handler(message);
  } catch (const MessageError& error) {
    bus->drop(message.channel, error.what());
  } catch (...) {
    logger::error("the handler of {} failed", message.channel);
    bus->failure_ = std::current_exception();
  }
}

}  // namespace nao
