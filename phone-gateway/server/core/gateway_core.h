#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "phone-gateway/server/core/audit_event.h"
#include "phone-gateway/server/core/exhibition_desk.h"
#include "phone-gateway/server/core/gateway_identity.h"
#include "phone-gateway/server/core/gateway_limits.h"
#include "phone-gateway/server/core/match_board.h"
#include "phone-gateway/server/core/message_bytes.h"
#include "phone-gateway/server/core/request_handler.h"
#include "phone-gateway/server/core/robots.h"
#include "phone-gateway/server/core/sessions.h"

namespace nao::gateway {

/** What a connection that can take a message does next. */
struct Outgoing {
  /** To be sent; null: nothing now. */
  MessageBytes message;
  /** Another one can be taken at once. */
  bool has_more = false;
  /** An image or a piece of audio is next, and was not to be taken. */
  bool is_long_due = false;
  /** The connection has to call set_unacknowledged() before the next call: an image is under way,
   * whose time is measured. */
  bool measures_image = false;
  /** The connection must close, if there is no message. */
  bool is_closing = false;
};

/** The behaviour of the gateway: joins sessions, robots and requests.
 *
 * It has no socket, bus, clock, file or log: connections pass in the messages that they received
 * and take out those to be sent; every call has its time, s of a clock that never runs backwards.
 * Nothing that a client sends makes it throw. */
class GatewayCore {
 public:
  /** @param robots  At least one, with different names.
   * @param audit   Receives the events for the audit log.
   * @param exhibition  Visitors drive the first robot in turn; none: clients take control. */
  GatewayCore(std::vector<RobotSetup> robots, const GatewayLimits& limits,
              const GatewayIdentity& identity, std::function<void(const AuditEvent&)> audit,
              std::optional<ExhibitionSetup> exhibition = std::nullopt);
  // The members refer to one another.
  GatewayCore(const GatewayCore&) = delete;
  GatewayCore& operator=(const GatewayCore&) = delete;

  // ---- Connections ----

  /** A connection was accepted.
   * @param wake  Called when next() has changed; must not call the core before it has returned.
   * @return Id of the session, counted up from 1. */
  uint32_t open(Endpoint endpoint, std::function<void()> wake, double now) {
    return sessions_.open(std::move(endpoint), std::move(wake), now);
  }

  /** A whole message was received.
   * @return Time for which the connection must pause reading, s: not 0 if the client exceeds its
   *   request rate or does not read its answers. */
  [[nodiscard]] double receive(uint32_t client, std::string_view message, double now);

  /** Sets the round-trip time that the transport has measured, s. @param least  In the last
   * minutes; 0: not known. */
  void set_round_trip_time(uint32_t client, double round_trip_time, double least = 0);
  /** Packets that the transport has repeated on this connection until now. */
  void set_repeated_packets(uint32_t client, uint32_t number, double now);
  /** Bytes that the client has not acknowledged: next() gives no image while there are many. */
  void set_unacknowledged(uint32_t client, size_t bytes, double now);

  /** The network layer has refused a connection. @param why  For the audit log; a fixed text, so
   *   that repetitions can be recognized. */
  void note_refusal(const std::string& address, const std::string& why);

  /** Closes a connection from the gateway's side, with a notice that says why. */
  void close(uint32_t client, const Reason& reason, double now);

  /** The connection has ended. @param why  For the audit log. */
  void closed(uint32_t client, const std::string& why, double now) {
    sessions_.remove(client, why, now);
  }

  /** Takes the next message for a connection that can take one.
   * @param takes_long  Also an image or a piece of audio. */
  [[nodiscard]] Outgoing next(uint32_t client, bool takes_long, double now);

  /** True from a successful Connect or Join until the client disconnects. */
  bool is_connected(uint32_t client) const;
  /** True if the connection must close as soon as next() has no message. */
  bool is_closing(uint32_t client) const;

  // ---- Robots ----

  /** In the order of the constructor. */
  GatewayRobot& robot(size_t index = 0) { return robots_.at(index); }
  const GatewayRobot& robot(size_t index = 0) const { return robots_.at(index); }
  size_t num_robots() const { return robots_.size(); }
  /** See Robots. */
  std::vector<CameraRequest> camera_requests(size_t robot, double now) const {
    return robots_.camera_requests(robot, now);
  }
  void add_image(size_t robot, CachedImage image, double now) {
    robots_.add_image(robot, std::move(image), now);
  }
  void set_players(std::vector<PlayerLabel> players) { robots_.set_players(std::move(players)); }
  void set_match(naoremote::Match match, double now) { match_.set(std::move(match), now); }

  // ---- Time ----

  /** Repetitions, timeouts and availability. Call it 50 times a second. */
  void step(double now);

  /** The gateway stops: walks end, and all connections are closed. */
  void shut_down(double now);

  // ---- State ----

  const Sessions& sessions() const { return sessions_; }
  /** nullptr: there is no exhibition. */
  const ExhibitionDesk* exhibition() const { return exhibition_.get(); }

 private:
  /** A connection, the session of its client, and what it sends of that one's outbox. */
  struct Sender {
    ClientSession* connection = nullptr;
    ClientSession* client = nullptr;
    Outbox::Part part = Outbox::Part::kAll;
  };
  /** @return Without a connection if there is none; without a client if that has ended. */
  Sender find_sender(uint32_t connection) const;
  /** Takes the first message of an outbox; null: what was due does not exist any more. */
  MessageBytes take(ClientSession& session, Outbox::Next first, double now);

  GatewayLimits limits_;
  std::function<void(const AuditEvent&)> audit_;
  Sessions sessions_;
  Robots robots_;
  MatchBoard match_;
  RequestHandler requests_;
  std::unique_ptr<ExhibitionDesk> exhibition_;
  /** Clients with an image under way. */
  std::vector<uint32_t> receiving_;
};

}  // namespace nao::gateway
