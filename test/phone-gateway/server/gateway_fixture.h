#pragma once

#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "phone-gateway/protocol/framing.h"
#include "phone-gateway/server/gateway_core.h"
#include "test/phone-gateway/server/test_robot.h"

namespace nao {

/** A gateway without sockets, bus or clock: time passes when a test says so, and motion and robot
 * speak until a test silences them. */
class GatewayFixture : public testing::Test {
 protected:
  /** A phone at the other end of a connection that never fails. */
  struct Phone {
    uint32_t id = 0;
    std::vector<naoremote::ServerMessage> received;
    uint32_t last_request_id = 0;
  };

  GatewayFixture() {
    // It prints a line for every message that it cannot parse.
    google::protobuf::SetLogHandler(nullptr);
    restart(GatewayLimits{});
  }

  void restart(const GatewayLimits& limits) {
    core_ = std::make_unique<GatewayCore>(
        make_test_robot(), limits, GatewayIdentity{"0.1.0", "secret", "phone.1", 1000},
        GatewayOutputs{[this](const NumberedCommand& command) { sent_.push_back(command); },
                       [this](const AuditEvent& event) { audit_.push_back(event); }});
    pass(0.1);
  }

  /** Lets time go by in steps of 20 ms, during which the robot's programs speak as they do. */
  void pass(double time) {
    const double end = now_ + time;
    while (now_ < end - 1e-9) {
      now_ += 0.02;
      if (motion_speaks_) {
        MotionSnapshot motion;
        motion.mode = has_robot_ ? Mode::kHolding : Mode::kNoRobot;
        core_->set_motion(motion, now_);
      }
      if (motion_speaks_ && has_robot_) {
        RobotSnapshot robot;
        robot.utime = static_cast<int64_t>(now_ * 1e6);
        robot.joint_position = {0.1, 0.2, 0.3, 0.4};
        core_->set_robot(robot, now_);
      }
      if (camera_speaks_) core_->heard_camera_status(now_);
      core_->step(now_);
    }
  }

  Phone open(bool is_local = true, const std::string& address = "127.0.0.1") {
    Phone phone;
    phone.id = core_->open(
        {address, "tcp", is_local}, [] {}, now_);
    return phone;
  }

  Phone connect(const std::string& name) {
    Phone phone = open();
    naoremote::Request request;
    request.mutable_connect()->set_protocol_version(kProtocolVersion);
    request.mutable_connect()->set_client_name(name);
    EXPECT_EQ(ask(phone, request).error(), naoremote::OK);
    return phone;
  }

  Phone connect_driver(const std::string& name) {
    Phone phone = connect(name);
    EXPECT_EQ(take_control(phone).error(), naoremote::OK);
    return phone;
  }

  /** Takes everything that waits for a phone. */
  void collect(Phone& phone) {
    while (const auto bytes = core_->next_message(phone.id, now_)) {
      naoremote::ServerMessage message;
      ASSERT_TRUE(message.ParseFromString(*bytes));
      phone.received.push_back(message);
    }
  }

  /** Sends a request and gives back its answer. */
  naoremote::Response ask(Phone& phone, naoremote::Request request) {
    request.set_request_id(++phone.last_request_id);
    (void)core_->receive(phone.id, request.SerializeAsString(), now_);
    collect(phone);
    for (auto it = phone.received.rbegin(); it != phone.received.rend(); ++it) {
      if (it->has_response() && it->response().request_id() == phone.last_request_id) {
        return it->response();
      }
    }
    ADD_FAILURE() << "no answer to " << request.ShortDebugString();
    return {};
  }

  naoremote::Response take_control(Phone& phone) {
    naoremote::Request request;
    request.mutable_take_control();
    return ask(phone, request);
  }
  naoremote::Response release_control(Phone& phone) {
    naoremote::Request request;
    request.mutable_release_control();
    return ask(phone, request);
  }
  naoremote::Response walk(Phone& phone, double vx, double vy = 0, double wz = 0) {
    naoremote::Request request;
    request.mutable_walk_turn()->set_vx(vx);
    request.mutable_walk_turn()->set_vy(vy);
    request.mutable_walk_turn()->set_wz(wz);
    return ask(phone, request);
  }
  naoremote::Response go_to(Phone& phone, const std::string& posture) {
    naoremote::Request request;
    request.mutable_go_to_posture()->set_posture(posture);
    return ask(phone, request);
  }
  naoremote::Response turn_head(Phone& phone, double yaw) {
    naoremote::Request request;
    request.mutable_change_joints()->set_group("head");
    request.mutable_change_joints()->set_yaw(yaw);
    return ask(phone, request);
  }
  naoremote::Response stop(Phone& phone) {
    naoremote::Request request;
    request.mutable_stop();
    return ask(phone, request);
  }
  naoremote::Response ping(Phone& phone) {
    naoremote::Request request;
    request.mutable_ping()->set_client_utime(7);
    return ask(phone, request);
  }
  naoremote::Response subscribe(Phone& phone, double state_rate, double image_rate) {
    naoremote::Request request;
    request.mutable_subscribe()->set_state_rate(state_rate);
    request.mutable_subscribe()->set_image_rate(image_rate);
    return ask(phone, request);
  }
  naoremote::Response operate(Phone& phone, naoremote::Operate::Operation operation,
                              uint32_t client = 0) {
    naoremote::Request request;
    request.mutable_operate()->set_operation(operation);
    request.mutable_operate()->set_client_id(client);
    return ask(phone, request);
  }

  void put_image(int64_t utime, uint32_t width = 320) {
    StoredImage image;
    image.utime = utime;
    image.camera = "top";
    image.width = width;
    image.height = width * 3 / 4;
    image.jpeg = "jpeg " + std::to_string(utime);
    core_->add_image(image, now_);
  }

  /** Answers the last command as nao-motion would. */
  void answer_last(CommandStatus status, const std::string& reason = "") {
    ASSERT_FALSE(sent_.empty());
    core_->add_result({sent_.back().source, sent_.back().command_id, status, reason}, now_);
  }

  std::vector<naoremote::Notice> notices(Phone& phone, naoremote::Notice::Kind kind) {
    collect(phone);
    std::vector<naoremote::Notice> found;
    for (const auto& message : phone.received) {
      if (message.has_notice() && message.notice().kind() == kind) {
        found.push_back(message.notice());
      }
    }
    return found;
  }

  int num_states(Phone& phone) {
    collect(phone);
    return static_cast<int>(std::count_if(phone.received.begin(), phone.received.end(),
                                          [](const auto& message) { return message.has_state(); }));
  }

  std::vector<naoremote::Image> images(Phone& phone) {
    collect(phone);
    std::vector<naoremote::Image> found;
    for (const auto& message : phone.received) {
      if (message.has_image()) found.push_back(message.image());
    }
    return found;
  }

  template <class Command>
  int num_sent() const {
    return static_cast<int>(std::count_if(sent_.begin(), sent_.end(), [](const auto& sent) {
      return std::holds_alternative<Command>(sent.command);
    }));
  }

  /** The last walk velocity sent, or a failure. */
  WalkVelocity last_walk() const {
    for (auto it = sent_.rbegin(); it != sent_.rend(); ++it) {
      if (const auto* walk = std::get_if<WalkVelocity>(&it->command)) return *walk;
    }
    ADD_FAILURE() << "no walk was sent";
    return {};
  }

  double now_ = 100;
  bool motion_speaks_ = true;
  bool has_robot_ = true;
  bool camera_speaks_ = true;
  std::vector<NumberedCommand> sent_;
  std::vector<AuditEvent> audit_;
  std::unique_ptr<GatewayCore> core_;
};

}  // namespace nao
