#include "common/bus.h"

#include "common/error.h"
#include "common/logger.h"
#include "common/wall_clock.h"

namespace nao {

Bus::Bus(const std::string& url) : lcm_(url) {
  if (!lcm_.good()) {
    throw BusError("cannot open the message bus " + url +
                   ": the address is wrong, or this machine has no multicast route; "
                   "try: ip link set lo multicast on; ip route add 239.255.76.0/24 dev lo");
  }
}

// All messages that have arrived, without waiting; handlers run here.
void Bus::handle() {
  while (lcm_.handleTimeout(0) > 0) {
  }
}

bool Bus::handle_for(double timeout) {
  return lcm_.handleTimeout(static_cast<int>(timeout * 1e3)) > 0;
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

// Messages of all types on matching channels, not decoded: for recorders.
void Bus::publish_raw(const std::string& channel, std::span<const uint8_t> message) {
  count_sent(channel,
             lcm_.publish(channel, message.data(), static_cast<unsigned>(message.size())) == 0);
}

void Bus::subscribe_raw(const std::string& pattern,
                        std::function<void(const std::string&, const uint8_t*, int)> handler) {
  auto receiver = std::make_shared<RawReceiver>();
  receiver->call = std::move(handler);
  receiver->bus = this;
  // Chosen: about 2 s of the traffic of one robot, 500 messages/s.
  constexpr int kQueueCapacity = 1000;
  open_socket();
  filter_.pass_all();
  lcm_.subscribe(pattern, &RawReceiver::receive, receiver.get())->setQueueCapacity(kQueueCapacity);
  raw_receivers_.push_back(std::move(receiver));
}

void Bus::RawReceiver::receive(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  ++bus->counters_.num_in;
  // No exception may cross LCM's C code.
  try {
    call(channel, static_cast<const uint8_t*>(buffer->data), static_cast<int>(buffer->data_size));
  } catch (const std::exception& error) {
    bus->drop(channel, error.what());
  }
}

}  // namespace nao
