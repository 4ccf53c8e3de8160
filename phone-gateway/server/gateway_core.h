#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "phone-gateway/server/command_tracker.h"
#include "phone-gateway/server/driving_lease.h"
#include "phone-gateway/server/gateway_limits.h"
#include "phone-gateway/server/image_cache.h"
#include "phone-gateway/server/message_bytes.h"
#include "phone-gateway/server/motion_command.h"
#include "phone-gateway/server/part_monitor.h"
#include "phone-gateway/server/phone_robot.h"
#include "phone-gateway/server/phone_session.h"
#include "phone-gateway/server/robot_mirror.h"
#include "phone-gateway/server/walk_stream.h"
#include "remote.pb.h"

namespace nao {

/** Something worth remembering about who did what. */
struct AuditEvent {
  /** connected, refused, disconnected, drives, released or operator. */
  std::string event;
  /** 0 and empty for the operator's console. */
  uint32_t client_id = 0;
  std::string name;
  std::string address;
  /** Why, or with what. */
  std::string detail;
};

/** Who the gateway is. */
struct GatewayIdentity {
  std::string server_version;
  /** What clients on other hosts must say in Connect. */
  std::string token;
  /** Beginning of the sources of its commands, unique on the bus: "phone.4711". */
  std::string source;
  /** Number of its first command. Greater than those of every earlier run, since nao-motion acts
   * only once on each. */
  int64_t first_command_id = 1;
};

/** Where the gateway's decisions go. */
struct GatewayOutputs {
  std::function<void(const NumberedCommand&)> send;
  std::function<void(const AuditEvent&)> audit;
};

/** Result of a command as nao-motion gave it. */
struct CommandResult {
  std::string source;
  int64_t command_id = 0;
  CommandStatus status = CommandStatus::kAccepted;
  std::string reason;
};

/** What the gateway has counted since its start. */
struct GatewayCounters {
  uint64_t num_requests = 0;
  uint64_t num_refused = 0;
  uint64_t num_sent = 0;
  uint64_t num_skipped = 0;
};

/** A image that somebody watches. */
struct CameraRequest {
  ImageSelection image;
  /** 1/s, the highest of those who watch. */
  double rate = 0;

  bool operator==(const CameraRequest& other) const {
    return image.shows_same(other.image) && image.quality == other.image.quality &&
           rate == other.rate;
  }
};

/** All that the gateway decides: who is connected, who drives, what is asked of the robot, what
 * each client gets when.
 *
 * It knows no socket, bus, clock, file or log: connections give it the messages that they received
 * and take from it those to be sent; every call names its time, s of a clock that never runs
 * backwards. Nothing that a client sends makes it throw. */
class GatewayCore {
 public:
  GatewayCore(PhoneRobot robot, const GatewayLimits& limits, GatewayIdentity identity,
              GatewayOutputs outputs);

  // ---- Connections ----

  /** A connection was accepted.
   * @param wake  Called when next_message() or is_closing() have something new to say; must not
   *   call the core at once.
   * @return Its number, counted up from 1. */
  uint32_t open(Peer peer, std::function<void()> wake, double now);

  /** A whole message came.
   * @return How long the connection shall pause reading, s: not 0 if the client sends faster than
   *   allowed or does not read its answers. */
  [[nodiscard]] double receive(uint32_t client, std::string_view message, double now);

  /** How long the network takes to the client and back, s, as the transport measures it. */
  void set_round_trip(uint32_t client, double round_trip);

  /** Somebody was turned away by the network layer.
   * @param why  For the audit log; one of a few sentences. */
  void note_refusal(const std::string& address, const std::string& why);

  /** The client broke the rules of its transport: it is told why, and the connection closes. */
  void violate(uint32_t client, const std::string& why, double now);

  /** The connection is gone, for whatever reason. */
  void closed(uint32_t client, const std::string& why, double now);

  /** Next message for a connection that can take one; null if there is none. */
  [[nodiscard]] MessageBytes next_message(uint32_t client, double now);

  /** True if that message would be an image. */
  bool is_image_next(uint32_t client) const;

  /** True once Connect has succeeded, until the client has no say any more. */
  bool has_connected(uint32_t client) const;

  /** True if the connection shall close as soon as next_message() has nothing left. */
  bool is_closing(uint32_t client) const;

  // ---- Robot ----

  void set_robot(const RobotSnapshot& robot, double now);
  void set_motion(const MotionSnapshot& motion, double now);
  void add_image(StoredImage image, double now);
  void heard_camera_status(double now) { parts_.heard_camera_status(now); }
  void add_result(const CommandResult& result, double now);

  /** Images that somebody watches now. */
  std::vector<CameraRequest> camera_requests(double now) const;

  // ---- Time ----

  /** To be called 50 times a second: repetitions, time-outs, link loss. */
  void step(double now);

  /** The gateway ends: the walk ends, and everybody is told. */
  void shut_down(double now);

  // ---- Figures ----

  const PhoneRobot& robot() const { return robot_; }
  bool is_available(PartMonitor::Part part) const { return parts_.is_available(part); }
  int num_connected() const;
  /** Sessions by number, for the figures. */
  const std::map<uint32_t, std::unique_ptr<PhoneSession>>& sessions() const { return sessions_; }
  uint32_t driver() const { return lease_.driver(); }
  /** Of all clients, also those that have gone. */
  GatewayCounters counters() const;

 private:
  using Request = naoremote::Request;
  using Response = naoremote::Response;

  PhoneSession* find(uint32_t client) const;

  // Use cases. Each fills in the response.
  void answer(PhoneSession& session, const Request& request, Response& response, double now);
  void connect(PhoneSession& session, const naoremote::Connect& request, Response& response,
               double now);
  void get_state(PhoneSession& session, const naoremote::GetState& request, Response& response,
                 double now);
  void subscribe(PhoneSession& session, const naoremote::Subscribe& request, Response& response);
  void walk_turn(PhoneSession& session, const Request& request, Response& response, double now);
  void move(PhoneSession& session, const Request& request,
            std::variant<MotionCommand, Refusal> checked, Response& response, double now);
  void stop(PhoneSession& session, const Request& request, Response& response, double now);
  void take_control(PhoneSession& session, Response& response, double now);
  void operate(PhoneSession& session, const naoremote::Operate& request, Response& response,
               double now);

  /** Whether a client may connect; fills in the response if not. */
  bool admit(const PhoneSession& session, const naoremote::Connect& request, Response& response,
             double now);
  bool is_right_token(const PhoneSession& session, const std::string& token) const;
  std::string unique_name(const std::string& wished, uint32_t client) const;
  /** Whether a client drives and the robot is there; fills in the response if not. */
  bool may_drive(const PhoneSession& session, Response& response);

  NumberedCommand number(const PhoneSession& session, MotionCommand command);
  /** Sends an event command: it is repeated until nao-motion answers. */
  void send_event(uint32_t client, uint32_t request_id, const NumberedCommand& command, double now);
  void send_walk(double now);

  MessageBytes encode_state(double now);
  MessageBytes encode_image(StoredImage& stored, double now);
  void write_image(const StoredImage& stored, naoremote::Image& image, double now) const;
  void push(PhoneSession& session, const naoremote::ServerMessage& message);
  void push(PhoneSession& session, MessageBytes message);
  void broadcast(const naoremote::ServerMessage& message);
  void tell_outcome(const CommandTracker::Entry& entry, CommandStatus status,
                    const std::string& reason, double now);
  void tell_control_changed(const std::string& message);
  void tell_part(PhoneSession* session, const PartMonitor::Change& change);
  naoremote::Control control_for(const PhoneSession& session) const;
  std::string driver_name() const;

  /** Closes a connection from this side, saying why. */
  void close_session(PhoneSession& session, const std::string& why, double now);
  /** The client has no say any more. */
  void leave(PhoneSession& session, const std::string& why, double now);
  /** What a use case left to do until its answer was on its way. */
  void follow_up(PhoneSession& session, double now);
  void end_walk(double now);
  void step_commands(double now);
  void step_parts(double now);
  void step_sessions(double now);
  void audit(const std::string& event, const PhoneSession& session, const std::string& detail);

  PhoneRobot robot_;
  GatewayLimits limits_;
  GatewayIdentity identity_;
  GatewayOutputs outputs_;

  std::map<uint32_t, std::unique_ptr<PhoneSession>> sessions_;
  uint32_t last_client_id_ = 0;
  /** Of those that have gone. */
  GatewayCounters past_counters_;
  int64_t next_command_id_;

  RobotMirror mirror_;
  SharedEncoding state_encoding_;
  ImageCache images_;
  PartMonitor parts_;
  DrivingLease lease_;
  WalkStream walk_;
  CommandTracker commands_;

  /** Stop was pressed during a walk: no new one until the driver lets go. */
  bool is_walk_held_ = false;
  double last_walk_turn_ = -1e9;
  /** Last outcome told about a walk: repeated ones within 2 s are kept back. */
  std::string last_walk_reason_;
  double last_walk_reason_time_ = -1e9;
  double next_stale_state_ = 0;

  struct WrongTokens {
    int count = 0;
    double last = 0;
  };
  std::map<std::string, WrongTokens> wrong_tokens_;
};

}  // namespace nao
