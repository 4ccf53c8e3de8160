#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/bus_socket.h"
#include "common/error.h"
#include "common/rate_limiter.h"

namespace nao {

/** Messages received, sent, and dropped (undecodable, or with a MessageError) since the start. */
struct BusCounters {
  int64_t num_in = 0;
  int64_t num_out = 0;
  int64_t num_dropped = 0;
};

/** A message as it was received. */
struct RawMessage {
  std::string channel;
  std::span<const uint8_t> bytes;
  /** Wall clock at its reception, microseconds since 1970. */
  int64_t wall_utime;
};

/** Decodes a whole message.
 * @return false if the bytes are not a Message of this version of the project. */
template <class Message>
bool decode_message(std::span<const uint8_t> bytes, Message& message) {
  const int size = static_cast<int>(bytes.size());
  return message.decode(bytes.data(), 0, size) == size;
}

/** The message bus: LCM, with protection against malformed messages.
 *
 * Messages on channels that nobody has subscribed to do not wake the process (BusSocket).
 * A message that does not decode, or whose handler throws a MessageError, is counted, reported at
 * most once a second, and dropped. Any other exception of a handler ends handle(), and so the
 * program, which its supervisor restarts. Not thread-safe. */
class Bus {
 public:
  /** Queue of one subscription: with kLatest one message waits for handle(), and others that arrive
   * meanwhile are dropped; with kAll every message waits. */
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
   * @param queue  kLatest for states, of which the next one will do, kAll for events.
   * @throws BusError  if this host does not receive the bus. */
  template <class Message>
  void subscribe(const std::string& channel, Queue queue,
                 std::function<void(const Message&)> handler) {
    subscribe_encoded(channel, queue, [handler = std::move(handler)](const RawMessage& raw) {
      Message message;
      if (!decode_message(raw.bytes, message)) {
        throw MessageError(std::string("it is damaged, or not a ") + Message::getTypeName() +
                           " of this version of the project");
      }
      handler(message);
    });
  }

  /** As subscribe(), with messages undecoded: for receivers that decode few of many. */
  void subscribe_encoded(const std::string& channel, Queue queue,
                         std::function<void(const RawMessage&)> handler) {
    add_receiver(channel, channel, queue == Queue::kLatest ? 1 : 0, std::move(handler));
    socket_.add(channel);
  }

  /** Whether messages on a subscribed channel wake the process: what is not needed for a while is
   * left to the kernel's filter. Without it, as on "memq://", they still come. */
  void set_awake(const std::string& channel, bool is_awake) {
    socket_.remove(channel);
    if (is_awake) socket_.add(channel);
  }

  /** Calls `handler` for every message on the channels whose whole name matches a regular
   * expression, undecoded: for loggers and viewers.
   * @param queue_capacity  Messages that wait for handle(); 0: any number. Default: about 2 s of
   * the traffic of one robot, 500 messages/s.
   * @throws BusError  if this host does not receive the bus, or the expression is wrong. */
  void subscribe_raw(const std::string& pattern, std::function<void(const RawMessage&)> handler,
                     int queue_capacity = 1000);

  /** Descriptor that is readable while a message is queued; for EventLoop::on_readable(). */
  int descriptor() {
    open_socket();
    return socket_.descriptor() >= 0 ? socket_.descriptor() : lcm_.getFileno();
  }

  /** Handles every queued message without blocking. @throws What a handler throws. */
  void handle();

  /** Waits up to `timeout` seconds for a message and handles it. @return false if none came.
   * @throws What a handler throws. */
  bool handle_for(double timeout);

  const BusCounters& counters() const { return counters_; }

 private:
  struct Receiver {
    Bus* bus;
    /** Empty: of a pattern. */
    std::string channel;
    /** 0: any number. */
    int queue_capacity;
    std::function<void(const RawMessage&)> handler;
    void receive(const RawMessage& message) const;
  };

  /** LCM opens its socket when it first has to receive. */
  void open_socket() {
    socket_.open([this] { return lcm_.getFileno(); });
  }
  void add_receiver(const std::string& pattern, const std::string& channel, int queue_capacity,
                    std::function<void(const RawMessage&)> handler);
  bool take_in();
  void handle_waiting();
  bool handle_lcm();
  bool handle_one();
  void count_sent(const std::string& channel, bool sent);
  void drop(const std::string& channel, const std::string& why);

  std::string url_;
  lcm::LCM lcm_;
  BusSocket socket_;
  std::vector<std::unique_ptr<Receiver>> receivers_;
  /** Messages that wait, in the order of their arrival. */
  struct Waiting {
    Receiver* receiver;
    std::vector<uint8_t> bytes;
    int64_t wall_utime;
  };
  std::deque<Waiting> waiting_;
  /** Memory of the last one, for the next. */
  std::vector<uint8_t> unused_;
  /** What a handler has thrown, while it waits for LCM's C code to return. */
  std::exception_ptr failure_;
  BusCounters counters_;
  RateLimiter warnings_{1.0};
};

}  // namespace nao
