#pragma once

#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/core/gateway_core.h"
#include "test/phone-gateway/server/core/test_robot.h"

namespace nao::gateway {

inline naoremote::Request make_connect(const std::string& token,
                                       unsigned version = kProtocolVersion) {
  naoremote::Request request;
  request.mutable_connect()->set_protocol_version(version);
  request.mutable_connect()->set_token(token);
  return request;
}

/** A gateway core without sockets, bus or clock: a test advances the time, and chooses which
 * components send messages. */
class GatewayFixture : public testing::Test {
 protected:
  /** A client on a connection that does not fail. */
  struct Client {
    uint32_t id = 0;
    std::vector<naoremote::ServerMessage> received;
    uint32_t last_request_id = 0;
  };

  GatewayFixture() {
    // The library prints a line for every message that it cannot parse.
    google::protobuf::SetLogHandler(nullptr);
    restart(GatewayLimits{});
  }

  void restart(const GatewayLimits& limits) {
    start(
        {{make_test_robot(),
          {.send = [this](const Command& command) { sent_.push_back(command); },
           .send_service = [this](const ServiceCommand& command) { services_.push_back(command); },
           .send_play = [this](const SentPlayCommand& command) { plays_.push_back(command); }}}},
        limits);
  }

  void start(std::vector<RobotSetup> robots, const GatewayLimits& limits) {
    core_ = std::make_unique<GatewayCore>(
        std::move(robots), limits, GatewayIdentity{"0.1.0", "secret", "phone.1", 1000},
        [this](const AuditEvent& event) { audit_.push_back(event); }, exhibition_);
    pass(0.1);
  }

  /** Advances the time in steps of 20 ms. */
  void pass(double time) {
    const double end = now_ + time;
    while (now_ < end - 1e-9) {
      now_ += 0.02;
      for (size_t i = 0; i < core_->num_robots(); ++i) {
        if (i != absent_robot_) receive_state(core_->robot(i));
      }
      core_->step(now_);
    }
  }

  /** Messages of one robot, as far as its components are there. */
  void receive_state(GatewayRobot& robot) {
    if (has_motion_) {
      MotionSnapshot motion;
      motion.mode = has_robot_ ? Mode::kHolding : Mode::kNoRobot;
      robot.set_motion(motion, now_);
    }
    if (has_motion_ && has_robot_) {
      RobotSnapshot state;
      state.utime = static_cast<int64_t>(now_ * 1e6);
      state.joint_position = {0.1, 0.2, 0.3, 0.4};
      state.torso_position = {torso_x_, 0, 0.3};
      robot.set_state(state, now_);
    }
    if (has_camera_) robot.components().handle_camera_status(now_);
  }

  Client open(bool is_local = true, const std::string& address = "127.0.0.1") {
    Client client;
    const auto wake = [] {};
    client.id = core_->open({address, "tcp", is_local}, wake, now_);
    return client;
  }

  /** A client with an invitation, over the relay. */
  Client invite(bool is_watcher, bool is_operator = false) {
    Client client;
    client.id = core_->open(
        {"invitation 0123", "relay", false, true, is_watcher, is_operator}, [] {}, now_);
    return client;
  }

  Client connect(const std::string& name) {
    Client client = open();
    naoremote::Request request;
    request.mutable_connect()->set_protocol_version(kProtocolVersion);
    request.mutable_connect()->set_client_name(name);
    EXPECT_EQ(ask(client, request).error(), naoremote::OK);
    return client;
  }

  Client connect_driver(const std::string& name) {
    Client client = connect(name);
    EXPECT_EQ(take_control(client).error(), naoremote::OK);
    return client;
  }

  /** Takes all messages that are queued for a client; what was sent before has arrived. */
  void collect(Client& client) {
    core_->set_unacknowledged(client.id, 0, now_);
    while (const auto bytes = core_->next(client.id, true, now_).message) {
      naoremote::ServerMessage message;
      ASSERT_TRUE(message.ParseFromString(*bytes));
      client.received.push_back(message);
    }
  }

  /** Sends a request and returns its answer. */
  naoremote::Response ask(Client& client, naoremote::Request request) {
    request.set_request_id(++client.last_request_id);
    (void)core_->receive(client.id, request.SerializeAsString(), now_);
    collect(client);
    for (auto it = client.received.rbegin(); it != client.received.rend(); ++it) {
      if (it->has_response() && it->response().request_id() == client.last_request_id) {
        return it->response();
      }
    }
    ADD_FAILURE() << "no answer to " << request.ShortDebugString();
    return {};
  }

  naoremote::Response take_control(Client& client) {
    naoremote::Request request;
    request.mutable_take_control();
    return ask(client, request);
  }
  /** Is refused, and waits. */
  naoremote::Response wait_for_control(Client& client) {
    naoremote::Request request;
    request.mutable_take_control()->set_wait(true);
    return ask(client, request);
  }
  naoremote::Response release_control(Client& client, uint32_t successor = 0) {
    naoremote::Request request;
    request.mutable_release_control()->set_successor_id(successor);
    return ask(client, request);
  }
  naoremote::Response walk(Client& client, double vx, double vy = 0, double wz = 0) {
    naoremote::Request request;
    request.mutable_walk_turn()->set_vx(vx);
    request.mutable_walk_turn()->set_vy(vy);
    request.mutable_walk_turn()->set_wz(wz);
    return ask(client, request);
  }
  naoremote::Response go_to(Client& client, const std::string& posture) {
    naoremote::Request request;
    request.mutable_go_to_posture()->set_posture(posture);
    return ask(client, request);
  }
  naoremote::Response turn_head(Client& client, double yaw) {
    naoremote::Request request;
    request.mutable_change_joints()->set_group("head");
    request.mutable_change_joints()->set_yaw(yaw);
    return ask(client, request);
  }
  naoremote::Response stop(Client& client) {
    naoremote::Request request;
    request.mutable_stop();
    return ask(client, request);
  }
  naoremote::Response ping(Client& client) {
    naoremote::Request request;
    request.mutable_ping()->set_client_utime(7);
    return ask(client, request);
  }
  naoremote::Response subscribe(Client& client, double state_rate, double image_rate) {
    naoremote::Request request;
    request.mutable_subscribe()->set_state_rate(state_rate);
    request.mutable_subscribe()->set_image_rate(image_rate);
    return ask(client, request);
  }
  naoremote::Response operate(Client& client, naoremote::Operate::Operation operation,
                              uint32_t target = 0) {
    naoremote::Request request;
    request.mutable_operate()->set_operation(operation);
    request.mutable_operate()->set_client_id(target);
    return ask(client, request);
  }

  void receive_image(int64_t utime, uint32_t width = 320) {
    CachedImage image;
    image.utime = utime;
    image.camera = "top";
    image.width = width;
    image.height = width * 3 / 4;
    image.jpeg = "jpeg " + std::to_string(utime);
    core_->robot().add_image(image, now_);
  }

  /** Sends a result of the last command, as nao-motion does. */
  void answer_last(ResultStatus status, const std::string& reason = "") {
    ASSERT_FALSE(sent_.empty());
    CommandResult result;
    result.source = sent_.back().source;
    result.id = sent_.back().id;
    result.kind = kind_of(sent_.back());
    result.status = status;
    result.sentence = reason;
    core_->robot().handle_result(result, now_);
  }

  std::vector<naoremote::Notice> notices(Client& client, naoremote::Notice::Kind kind) {
    collect(client);
    std::vector<naoremote::Notice> found;
    for (const auto& message : client.received) {
      if (message.has_notice() && message.notice().kind() == kind) {
        found.push_back(message.notice());
      }
    }
    return found;
  }

  int num_states(Client& client) {
    collect(client);
    return static_cast<int>(std::count_if(client.received.begin(), client.received.end(),
                                          [](const auto& message) { return message.has_state(); }));
  }

  std::vector<naoremote::Image> images(Client& client) {
    collect(client);
    std::vector<naoremote::Image> found;
    for (const auto& message : client.received) {
      if (message.has_image()) found.push_back(message.image());
    }
    return found;
  }

  /** Commands of one kind that were sent. */
  template <class Request>
  int num_sent() const {
    return static_cast<int>(std::count_if(sent_.begin(), sent_.end(), [](const auto& sent) {
      return std::holds_alternative<Request>(sent.request);
    }));
  }

  /** The last walk velocity that was sent. */
  WalkCommand last_walk() const {
    for (auto it = sent_.rbegin(); it != sent_.rend(); ++it) {
      if (const auto* walk = std::get_if<WalkCommand>(&it->request)) return *walk;
    }
    ADD_FAILURE() << "no walk was sent";
    return {};
  }

  double now_ = 100;
  /** Exhibition of the next core. */
  std::optional<ExhibitionSetup> exhibition_;
  /** Where the robot is in its odometry frame, m. */
  double torso_x_ = 0;
  /** Which components send messages. */
  bool has_motion_ = true;
  bool has_robot_ = true;
  bool has_camera_ = true;
  /** Index of a robot that sends no messages; by default none. */
  size_t absent_robot_ = SIZE_MAX;
  std::vector<Command> sent_;
  std::vector<ServiceCommand> services_;
  std::vector<SentPlayCommand> plays_;
  std::vector<AuditEvent> audit_;
  std::unique_ptr<GatewayCore> core_;
};

}  // namespace nao::gateway
