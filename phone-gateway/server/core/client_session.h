#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "phone-gateway/server/core/image_pacer.h"
#include "phone-gateway/server/core/outbox.h"
#include "phone-gateway/server/core/request_age.h"
#include "phone-gateway/server/core/request_budget.h"
#include "phone-gateway/server/core/request_check.h"
#include "phone-gateway/server/core/stream_throttle.h"

namespace nao::gateway {

/** The other end of a connection. */
struct Endpoint {
  /** IP address without port. */
  std::string address;
  /** "websocket" or "tcp". */
  std::string transport;
  /** On the gateway's own host. */
  bool is_local = false;
};

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
  ClientSession(uint32_t session_id, Endpoint session_endpoint,
                std::function<void()> wake_connection, double max_request_rate, double now)
      : id(session_id),
        endpoint(std::move(session_endpoint)),
        wake(std::move(wake_connection)),
        opened_at(now),
        last_request(now),
        budget(max_request_rate, now) {}

  /** Queues a message; does nothing while the session is closing. */
  void send(MessageBytes message) {
    if (is_closing) return;
    outbox.push(std::move(message));
    wake();
  }
  void send(const naoremote::ServerMessage& message) { send(encode(message)); }

  void request_state() {
    outbox.request_state();
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

  ClientCounters calc_counters() const {
    return {num_requests, num_refused, num_sent, outbox.num_skipped()};
  }

  uint32_t id;
  Endpoint endpoint;
  /** Notifies the connection that there is something to send, or that it must close. */
  std::function<void()> wake;
  std::string name;
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
  uint64_t num_requests = 0;
  uint64_t num_refused = 0;
  uint64_t num_sent = 0;
};

}  // namespace nao::gateway
