#include "tools/bench/link_phone.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cmath>
#include <naolcm/walk_command_t.hpp>
#include <utility>

#include "common/channels.h"
#include "common/wall_clock.h"

namespace nao::bench {
namespace {

// What the app does: app.ts, walk_sender.ts, connection.ts, store.ts.
constexpr double kStateRate = 60;
constexpr double kImageRate = 15;
constexpr double kWalkPeriod = 0.1;
constexpr double kPingPeriod = 1;
constexpr double kStaleAge = 0.5;
/** Period of another command of the driver, s. Chosen. */
constexpr double kTurnPeriod = 2;
/** Age above which no command may be obeyed, s; see PROTOCOL.md. */
constexpr double kMaxCommandAge = 0.4;
/** The walk: a circle, m/s and rad/s. Each command has a velocity to the side of its own, which
 * names it on the bus: the gateway scales all three by the same factor. */
constexpr double kForward = 0.08;
constexpr double kTurn = 0.3;
constexpr double kSideStep = 1e-6;
constexpr double kPollTime = 0.005;
constexpr size_t kNumPings = 20;
constexpr uint32_t kJoinId = 1000000000;
constexpr const char* kJoinKey = "bench phone";

}  // namespace

void ClockRelation::add(double sent_at, double received_at, double gateway_time) {
  samples_.push_back({received_at - sent_at, gateway_time - (sent_at + received_at) / 2});
  if (samples_.size() > kNumPings) samples_.pop_front();
  // The fastest ping says most.
  offset_ = std::min_element(samples_.begin(), samples_.end(), [](const auto& a, const auto& b) {
              return a.round_trip < b.round_trip;
            })->offset;
}

LinkPhone::LinkPhone(GatewayStack& stack, const EmulatedLink& link, bool has_second)
    : stack_(stack), link_(link), has_second_(has_second) {
  subscribe_to_bus();
}

void LinkPhone::subscribe_to_bus() {
  const RobotChannels channels;
  stack_.bus().subscribe<naolcm::walk_command_t>(
      channels.walk_command, Bus::Queue::kAll, [this](const auto& message) {
        if (!is_driving_) return;
        const bool is_zero = message.vx == 0 && message.vy == 0 && message.wz == 0;
        if (is_zero && was_walking_) ++seen_.num_ends;
        was_walking_ = !is_zero;
        const bool is_moving = message.vx > 0.01 * kForward;
        if (!is_moving && was_moving_) ++seen_.num_halts;
        was_moving_ = is_moving;
        if (!is_moving) return;
        const auto number =
            static_cast<size_t>(std::lround(message.vy / message.vx * kForward / kSideStep));
        // The gateway repeats the newest one.
        if (number <= last_walk_on_bus_ || number > walk_times_.size()) return;
        last_walk_on_bus_ = number;
        if (monotonic_seconds() - walk_times_[number - 1] > kMaxCommandAge) {
          ++seen_.num_old_commands;
        }
      });
}

DrivenTime LinkPhone::drive(double time, uint32_t image_width) {
  seen_ = {};
  connect(image_width);
  const auto run = [&](double end) {
    while (monotonic_seconds() < end) {
      try {
        send_due(monotonic_seconds());
        stack_.run_for(kPollTime);
      } catch (const std::runtime_error&) {
        ++seen_.num_lost_connections;
        connect(image_width);
      }
    }
  };
  // The first steps.
  run(monotonic_seconds() + 3);
  seen_ = {};
  is_driving_ = true;
  run(monotonic_seconds() + time);
  is_driving_ = false;
  stack_.forget_clients();
  client_.reset();
  second_.reset();
  // The walk ends.
  stack_.run_for(2);
  return std::move(seen_);
}

void LinkPhone::connect(uint32_t image_width) {
  stack_.forget_clients();
  const double now = monotonic_seconds();
  for (const auto& [id, sent_at] : unanswered_) seen_.answer_ms.push_back((now - sent_at) * 1e3);
  unanswered_.clear();
  second_.reset();
  has_joined_ = false;
  clock_ = {};
  client_ = open();
  naoremote::Request request = connect_request("phone");
  request.mutable_connect()->set_token(GatewayStack::kToken);
  if (has_second_) request.mutable_connect()->set_join_key(kJoinKey);
  client_->send(request);
  newest_state_ = now;
  naoremote::Request take;
  take.mutable_take_control();
  send(take);
  naoremote::Request subscribe;
  subscribe.mutable_subscribe()->set_state_rate(kStateRate);
  subscribe.mutable_subscribe()->set_image_rate(kImageRate);
  subscribe.mutable_subscribe()->mutable_image()->set_width(image_width);
  subscribe.mutable_subscribe()->set_play_state(true);
  subscribe.mutable_subscribe()->set_vision(true);
  send(subscribe);
}

std::unique_ptr<WireClient> LinkPhone::open() {
  std::unique_ptr<WireClient> client;
  link_.on_other_host(
      [&] { client = connect_websocket(stack_.http_port(), EmulatedLink::kHereAddress); });
  // Phones have cubic, whatever this machine's default is.
  constexpr std::string_view kCubic = "cubic";
  setsockopt(client->descriptor(), IPPROTO_TCP, TCP_CONGESTION, kCubic.data(), kCubic.size());
  stack_.watch(client.get(), [this](const auto& message, double at) { receive(message, at); });
  return client;
}

void LinkPhone::join(uint32_t client_id) {
  second_ = open();
  naoremote::Request request;
  request.set_request_id(kJoinId);
  request.mutable_join()->set_client_id(client_id);
  request.mutable_join()->set_key(kJoinKey);
  second_->send(request);
}

void LinkPhone::send_due(double now) {
  if (joining_ != 0) join(std::exchange(joining_, 0));
  if (now >= next_walk_) {
    next_walk_ = std::max(next_walk_ + kWalkPeriod, now);
    send_walk(now, now - newest_state_ > kStaleAge);
  }
  if (now >= next_turn_) {
    next_turn_ = now + kTurnPeriod;
    naoremote::Request request;
    request.mutable_change_joints()->set_group("head");
    request.mutable_change_joints()->set_yaw(head_yaw_);
    send(request, true);
    head_yaw_ = -head_yaw_;
  }
  if (now >= next_ping_) {
    next_ping_ = now + kPingPeriod;
    naoremote::Request request;
    request.mutable_ping()->set_client_utime(static_cast<uint64_t>(now * 1e6));
    send(request);
  }
}

void LinkPhone::send_walk(double now, bool is_locked) {
  naoremote::Request request;
  request.mutable_walk_turn();
  request.mutable_walk_turn()->set_is_held(is_locked);
  if (!is_locked) {
    walk_times_.push_back(now);
    request.mutable_walk_turn()->set_vx(kForward);
    request.mutable_walk_turn()->set_vy(static_cast<double>(walk_times_.size()) * kSideStep);
    request.mutable_walk_turn()->set_wz(kTurn);
  }
  send(request, true);
}

uint32_t LinkPhone::send(naoremote::Request request, bool is_command) {
  const double now = monotonic_seconds();
  request.set_request_id(++last_id_);
  request.set_sent_at(now);
  if (is_command) unanswered_[last_id_] = now;
  client_->send(request);
  if (has_joined_) second_->send(request);
  return last_id_;
}

void LinkPhone::receive(const naoremote::ServerMessage& message, double now) {
  if (message.has_response()) {
    receive_answer(message.response(), now);
  } else if (message.has_state()) {
    const auto sent_at = stack_.time_of_state(message.state().utime());
    // The app shows no state that is older than one it has.
    if (!sent_at || *sent_at <= newest_state_) return;
    newest_state_ = *sent_at;
    seen_.state_age_ms.push_back((now - *sent_at) * 1e3);
  } else if (message.has_image()) {
    const auto sent_at = stack_.time_of_state(message.image().utime());
    if (!sent_at) return;
    seen_.image_age_ms.push_back((now - *sent_at) * 1e3);
    seen_.shown_age_ms.push_back(message.image().age_ms() +
                                 clock_.calc_transit(message.image().sent_at(), now) * 1e3);
    seen_.image_bytes += static_cast<double>(message.image().jpeg().size());
  }
}

void LinkPhone::receive_answer(const naoremote::Response& response, double now) {
  if (response.has_connected() && has_second_) joining_ = response.connected().client_id();
  if (response.request_id() == kJoinId) has_joined_ = response.error() == naoremote::OK;
  if (response.has_pong()) {
    clock_.add(static_cast<double>(response.pong().client_utime()) * 1e-6, now,
               response.pong().sent_at());
  }
  const auto found = unanswered_.find(response.request_id());
  if (found == unanswered_.end()) return;
  seen_.answer_ms.push_back((now - found->second) * 1e3);
  unanswered_.erase(found);
}

}  // namespace nao::bench
