#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "phone-gateway/server/core/endpoint.h"
#include "phone-gateway/server/core/image_pacer.h"
#include "phone-gateway/server/core/outbox.h"
#include "phone-gateway/server/core/request_age.h"
#include "phone-gateway/server/core/request_budget.h"
#include "phone-gateway/server/core/request_check.h"
#include "phone-gateway/server/core/request_copies.h"
#include "phone-gateway/server/core/stream_throttle.h"

namespace nao::gateway {

/** The states and images that a client receives. */
struct ClientStreams {
  Subscription subscription;
  StreamThrottle state_throttle;
  StreamThrottle image_throttle;
  ImagePacer image_pacer;
  /** The images that it receives: what it wants, as far as its link can take them. */
  ImageSelection image() const { return image_pacer.reduce(subscription.image); }
  /** Images of the last GetState with image, and its time, s. */
  ImageSelection polled_image;
  double last_poll = -1e9;
  /** Number of the last image sent, as a stream or in an answer. */
  uint64_t last_image = 0;
};

/** Counters of a client, or of all clients. */
struct ClientCounters {
  uint64_t num_requests = 0;
  uint64_t num_refused = 0;
  uint64_t num_sent = 0;
  /** States and images that a newer one replaced before they could be sent. */
  uint64_t num_skipped = 0;
};

/** State of one connection, from its acceptance to its end. */
struct ClientSession {
  ClientSession(uint32_t session_id, Endpoint session_endpoint, std::function<void()> wake_function,
                double max_request_rate, double now)
      : id(session_id),
        endpoint(std::move(session_endpoint)),
        wake_connection(std::move(wake_function)),
        opened_at(now),
        last_request(now),
        budget(max_request_rate, now) {}

  /** Notifies the client's connections that there is something to send, or that one must close. */
  void wake() const {
    wake_connection();
    if (wake_second) wake_second();
  }

  /** Queues a message; does nothing while the session is closing. */
  void send(MessageBytes message) {
    if (is_closing) return;
    outbox.push(std::move(message));
    wake();
  }
  void send(const naoremote::ServerMessage& message) { send(encode(message)); }

  void request_state(double now) {
    outbox.request_state(second != 0 && is_lossy(now));
    wake();
  }
  void request_image() {
    outbox.request_image();
    wake();
  }

  void request_play_state() {
    outbox.request_play_state();
    wake();
  }
  void request_vision() {
    outbox.request_vision();
    wake();
  }

  void send_audio(MessageBytes piece) {
    if (is_closing) return;
    outbox.push_audio(std::move(piece));
    wake();
  }

  /** The network stack of the gateway has repeated so many packets of a connection until now. */
  void note_repeated_packets(uint32_t number, double now) {
    if (number > num_repeated_packets) last_loss = now;
    num_repeated_packets = number;
  }
  /** Whether packets of the connection get lost: states and answers go over both of a client's, as
   * neither waits for what was lost of the other. */
  bool is_lossy(double now) const { return now - last_loss < kLossMemory; }
  /** s. Chosen: at a loss of 1 % and 60 states a second one is repeated every 2 s. */
  static constexpr double kLossMemory = 10;

  ClientCounters calc_counters() const {
    return {num_requests, num_refused, num_sent, outbox.num_skipped()};
  }

  uint32_t id;
  Endpoint endpoint;
  std::function<void()> wake_connection;
  std::string name;
  /** This client's second connection: the key that it must know, its session, 0: there is none,
   * and its wake_connection. */
  std::string join_key;
  uint32_t second = 0;
  std::function<void()> wake_second;
  /** This is the second connection of that client; 0: of none. It has no name, and counts nowhere.
   */
  uint32_t first = 0;
  /** Only of a client with two connections. */
  std::unique_ptr<RequestCopies> copies;
  /** Connect has succeeded, and the client has not disconnected. */
  bool is_connected = false;
  /** Index of the robot that it watches. */
  size_t robot = 0;
  /** The operator lets it watch only. */
  bool is_muted = false;
  /** Its Connect was refused. */
  bool is_refused = false;
  /** Queued messages are still sent, then the connection closes; requests are ignored. */
  bool is_closing = false;
  /** s. */
  double opened_at;
  double last_request;
  RequestBudget budget;
  RequestAge age;
  int num_malformed = 0;
  Outbox outbox;
  ClientStreams streams;
  /** Round-trip time as the network stack measures it, s; 0 until it is known. */
  double round_trip_time = 0;
  /** The least one of the last minutes, s; 0 until it is known. */
  double least_round_trip = 0;
  uint32_t num_repeated_packets = 0;
  /** When the last one was noticed, s. */
  double last_loss = -1e9;
  uint64_t num_requests = 0;
  uint64_t num_refused = 0;
  uint64_t num_sent = 0;
};

}  // namespace nao::gateway
