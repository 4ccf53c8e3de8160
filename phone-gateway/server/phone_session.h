#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "phone-gateway/server/outbox.h"
#include "phone-gateway/server/pacer.h"
#include "phone-gateway/server/request_budget.h"
#include "phone-gateway/server/request_check.h"

namespace nao {

/** The other end of a connection. */
struct Peer {
  /** IP address without port. */
  std::string address;
  /** "websocket" or "tcp". */
  std::string transport;
  /** On the gateway's own host. */
  bool is_local = false;
};

/** What the gateway knows about one connection, from its opening to its end. */
struct PhoneSession {
  PhoneSession(uint32_t session_id, Peer session_peer, std::function<void()> wake_connection,
               const GatewayLimits& limits, double now)
      : id(session_id),
        peer(std::move(session_peer)),
        wake(std::move(wake_connection)),
        opened_at(now),
        last_heard(now),
        budget(limits.max_request_rate, now) {}

  uint32_t id;
  Peer peer;
  /** Tells the connection that there is something to send, or that it shall close. */
  std::function<void()> wake;
  std::string name;
  /** Connect has succeeded. */
  bool is_connected = false;
  /** Its Connect was refused. */
  bool is_refused = false;
  /** What waits is still sent, then the connection closes; nothing is taken in. */
  bool is_closing = false;
  double opened_at;
  double last_heard;
  RequestBudget budget;
  int num_malformed = 0;
  Outbox outbox;

  Subscription subscription;
  Pacer state_pacer;
  Pacer image_pacer;
  /** Wish of the last GetState with image, and when it came. */
  ImageSelection polled_image;
  double last_poll = -1e9;
  /** Number of the last image that it got, by stream or by poll. */
  uint64_t last_image = 0;

  // What follows the answer to the present request.
  bool tells_missing_parts = false;
  std::string tells_control_changed;
  std::string closes_because;

  /** To the client and back, s; 0 until it is known. */
  double round_trip = 0;
  uint64_t num_received = 0;
  uint64_t num_sent = 0;
  uint64_t num_refused = 0;
};

}  // namespace nao
