#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/channel_filter.h"
#include "common/rate_limiter.h"

namespace nao {

/** Messages received, sent, and dropped (undecodable, or rejected by a handler) since the start. */
struct BusCounters {
  int64_t num_in = 0;
  int64_t num_out = 0;
  int64_t num_dropped = 0;
};

/** The message bus: LCM, with protection against malformed messages.
 *
 * Messages on channels that nobody has subscribed to do not wake the process (ChannelFilter).
 * A message that does not decode, or whose handler throws, is counted, reported at most once a
 * second, and dropped. No exception propagates through LCM's C code. Not thread-safe. */
class Bus {
 public:
  /** Queue of one subscription: with kLatest one message waits for handle(), and LCM drops those
   * that arrive meanwhile; with kAll every message waits. */
  enum class Queue { kLatest, kAll };

  /** @param url  LCM URL: "udpm://239.255.76.67:7667?ttl=0"; "memq://" for tests in one process.
   * @throws BusError  if the bus cannot be opened; the text names the missing route. */
  explicit Bus(const std::string& url);
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /** Sends a message. A failure is counted as dropped and reported at most once a second. */
  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    count_sent(channel, lcm_.publish(channel, &message) == 0);
  }

  /** Sends an encoded message. A failure is handled as in publish(). */
  void publish_raw(const std::string& channel, std::span<const uint8_t> message);

  /** Calls `handler(message)` for every message on a channel, inside handle().
   * @param queue  kLatest for states, of which the next one will do, kAll for events. */
  template <class Message>
  void subscribe(const std::string& channel, Queue queue,
                 std::function<void(const Message&)> handler) {
    auto receiver = std::make_shared<Receiver>();
    receiver->call = [this, channel,
                      handler = std::move(handler)](const lcm::ReceiveBuffer& buffer) {
      try {
        Message message;
        // LCM's decoder throws where a text has the length 0.
        if (message.decode(buffer.data, 0, static_cast<int>(buffer.data_size)) < 0) {
          drop(channel, std::string("it is not a ") + Message::getTypeName() +
                            " of this version of the project");
          return;
        }
        handler(message);
      } catch (const std::exception& error) {
        drop(channel, error.what());
      }
    };
    receiver->counters = &counters_;
    open_socket();
    lcm::Subscription* subscription = lcm_.subscribe(channel, &Receiver::receive, receiver.get());
    subscription->setQueueCapacity(queue == Queue::kLatest ? 1 : 0);
    receivers_.push_back(std::move(receiver));
    filter_.add(channel);
  }

  /** Calls `handler(channel, data, num_bytes)` for every message on the channels that match a
   * regular expression, undecoded: for loggers and viewers. The queue holds 1000 messages. */
  void subscribe_raw(const std::string& pattern,
                     std::function<void(const std::string&, const uint8_t*, int)> handler);

  /** Descriptor that is readable while a message is queued; for EventLoop::on_readable(). */
  int descriptor() {
    open_socket();
    return lcm_.getFileno();
  }

  /** Handles every queued message without blocking. */
  void handle();

  /** Waits up to `timeout` seconds for a message and handles it. @return false if none came. */
  bool handle_for(double timeout);

  const BusCounters& counters() const { return counters_; }

 private:
  struct Receiver {
    std::function<void(const lcm::ReceiveBuffer&)> call;
    BusCounters* counters;
    void receive(const lcm::ReceiveBuffer* buffer, const std::string& /*channel*/) {
      ++counters->num_in;
      call(*buffer);
    }
  };

  struct RawReceiver {
    std::function<void(const std::string&, const uint8_t*, int)> call;
    Bus* bus;
    void receive(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  };

  /** LCM opens its socket when it first has to receive. */
  void open_socket() {
    filter_.open_socket([this] { (void)lcm_.getFileno(); });
  }
  void count_sent(const std::string& channel, bool sent);
  void drop(const std::string& channel, const std::string& why);

  lcm::LCM lcm_;
  ChannelFilter filter_;
  std::vector<std::shared_ptr<Receiver>> receivers_;
  std::vector<std::shared_ptr<RawReceiver>> raw_receivers_;
  BusCounters counters_;
  RateLimiter warnings_{1.0};
};

}  // namespace nao
