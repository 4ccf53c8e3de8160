#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "tools/bench/emulated_link.h"
#include "tools/bench/gateway_stack.h"

namespace nao::bench {

/** What a driver's phone has seen. */
struct DrivenTime {
  /** When the newest state or image arrived: the time since it was on the bus, ms. */
  std::vector<double> state_age_ms;
  std::vector<double> image_age_ms;
  /** The age of the same images as the app computes it. */
  std::vector<double> shown_age_ms;
  /** From each command to its answer. */
  std::vector<double> answer_ms;
  /** How often the walk was ended while the joystick was held. */
  int num_ends = 0;
  /** The same, and how often the robot stepped in place. */
  int num_halts = 0;
  /** Walk commands that came to the bus more than 0.4 s after the phone had sent them. */
  int num_old_commands = 0;
  int num_lost_connections = 0;
  /** Bytes of the images. */
  double image_bytes = 0;
};

/** Relates the gateway's clock to the phone's by pings, as clock_relation.ts. */
class ClockRelation {
 public:
  /** @param sent_at, received_at  Of a ping and its answer, s. @param gateway_time  When that was
   * sent, on the gateway's clock, s. */
  void add(double sent_at, double received_at, double gateway_time);
  /** How long a message was under way, s. @param sent_at  On the gateway's clock. */
  double calc_transit(double sent_at, double now) const { return now + offset_ - sent_at; }

 private:
  struct Sample {
    double round_trip;
    double offset;
  };
  std::deque<Sample> samples_;
  /** Gateway's clock minus the phone's, s. */
  double offset_ = 0;
};

/** A phone on the other end of an emulated link that sends and receives what the app does while its
 * joystick is held: a WalkTurn every 0.1 s, a turn of the head every 2 s, a ping a second, states
 * 60 and images 15 times a second. It sends zero while what it sees is old, as the app. */
class LinkPhone {
 public:
  /** @param has_second  Opens a second connection, as the app does. */
  LinkPhone(GatewayStack& stack, const EmulatedLink& link, bool has_second);

  /** Connects, drives for some time, s, and disconnects. @param image_width  Pixels.
   * @throws std::runtime_error  if there is no connection at the begin. */
  DrivenTime drive(double time, uint32_t image_width);

 private:
  void subscribe_to_bus();
  void connect(uint32_t image_width);
  void join(uint32_t client_id);
  std::unique_ptr<WireClient> open();
  void send_due(double now);
  void send_walk(double now, bool is_locked);
  uint32_t send(naoremote::Request request, bool is_command = false);
  void receive(const naoremote::ServerMessage& message, double now);
  void receive_answer(const naoremote::Response& response, double now);

  GatewayStack& stack_;
  const EmulatedLink& link_;
  bool has_second_;
  std::unique_ptr<WireClient> client_;
  /** Null: there is none. */
  std::unique_ptr<WireClient> second_;
  bool has_joined_ = false;
  /** Number of this client, whose second connection is to be opened; 0: it is, or must not be. */
  uint32_t joining_ = 0;
  ClockRelation clock_;
  DrivenTime seen_;
  bool is_driving_ = false;
  bool was_walking_ = false;
  bool was_moving_ = false;
  uint32_t last_id_ = 1;
  /** Commands without answer, and when they were sent, s. */
  std::map<uint32_t, double> unanswered_;
  /** When the walk commands were sent, s. */
  std::vector<double> walk_times_;
  size_t last_walk_on_bus_ = 0;
  /** When the newest state that was received was on the bus, s. */
  double newest_state_ = 0;
  double next_walk_ = 0;
  double next_turn_ = 0;
  double next_ping_ = 0;
  double head_yaw_ = 0.1;
};

}  // namespace nao::bench
