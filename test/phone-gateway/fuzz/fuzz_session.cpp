// Input of libFuzzer: messages of two connections to the gateway's core, one of them from another
// host, with a robot that answers. For each message one byte that selects other events, one byte of
// length, and the message.
#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include "phone-gateway/server/core/gateway_core.h"
#include "test/phone-gateway/server/core/test_robot.h"

namespace nao::gateway {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

/** Conditions that every command must fulfil, whatever a client sends. */
void check(const Command& command) {
  require(command.id != 0 && !command.source.empty());
  if (const auto* walk = std::get_if<WalkCommand>(&command.request)) {
    require(std::abs(walk->vx) <= 0.2 && std::abs(walk->vy) <= 0.15 && std::abs(walk->wz) <= 1);
  } else if (const auto* posture = std::get_if<PostureCommand>(&command.request)) {
    require(posture->speed > 0 && posture->speed <= 1);
  } else if (const auto* change = std::get_if<JointChangeCommand>(&command.request)) {
    require(change->joint_names.size() == change->joint_position.size());
    for (const double value : change->joint_position) require(std::isfinite(value));
  } else if (const auto* goal = std::get_if<MoveToCommand>(&command.request)) {
    require(std::isfinite(goal->x) && std::isfinite(goal->y) && std::isfinite(goal->theta));
  }
}

/** A core with two connections. */
class FuzzedGateway {
 public:
  FuzzedGateway()
      : core_(make_robots(), GatewayLimits{}, {"0.1.0", "k", "phone.1", 1},
              [](const AuditEvent&) {}) {
    for (int i = 0; i < 2; ++i) open(i);
  }

  /** Receives a message. @param events  Bit 0: the connection; bit 1: time passes; bit 2: the
   * client reads; bit 3: nao-motion answers the last command with the status in bits 4 to 7. */
  void receive(uint8_t events, std::string_view message) {
    const int client = events & 1;
    (void)core_.receive(ids_[client], message, now_);
    if ((events & 2) != 0) pass();
    if ((events & 4) != 0) collect(client);
    if ((events & 8) != 0 && last_.id != 0) {
      CommandResult result;
      result.source = last_.source;
      result.id = last_.id;
      result.kind = kind_of(last_);
      result.status = static_cast<ResultStatus>((events >> 4) % 5);
      result.sentence = "because";
      core_.robot().handle_result(result, now_);
    }
    if (core_.is_closing(ids_[client])) {
      collect(client);
      core_.closed(ids_[client], "fuzz", now_);
      open(client);
    }
  }

 private:
  std::vector<RobotSetup> make_robots() {
    const auto send = [this](const Command& command) {
      check(command);
      last_ = command;
    };
    std::vector<RobotSetup> robots{{make_test_robot(), {send}}, {make_test_robot(), {send}}};
    robots[1].description.set_name("NAO2");
    return robots;
  }
  void open(int client) {
    const Endpoint endpoint{client == 0 ? "127.0.0.1" : "10.0.0.1", "tcp", client == 0};
    const auto wake = [] {};
    ids_[client] = core_.open(endpoint, wake, now_);
  }
  void pass() {
    now_ += 0.2;
    MotionSnapshot motion;
    motion.mode = Mode::kHolding;
    motion.stiffness = 1;
    RobotSnapshot robot;
    robot.utime = static_cast<int64_t>(now_ * 1e6);
    robot.joint_position.assign(4, 0);
    for (size_t i = 0; i < core_.num_robots(); ++i) {
      core_.robot(i).set_motion(motion, now_);
      core_.robot(i).set_state(robot, now_);
    }
    CachedImage image;
    image.camera = "top";
    image.width = 320;
    image.jpeg = "jpeg";
    core_.robot().add_image(image, now_);
    core_.step(now_);
  }
  void collect(int client) {
    while (core_.next(ids_[client], true, now_).message) {
    }
  }

  double now_ = 100;
  uint32_t ids_[2] = {};
  Command last_;
  GatewayCore core_;
};

}  // namespace
}  // namespace nao::gateway

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  google::protobuf::SetLogHandler(nullptr);
  nao::gateway::FuzzedGateway gateway;
  while (size >= 2) {
    const uint8_t events = data[0];
    const size_t length = std::min<size_t>(data[1], size - 2);
    gateway.receive(events, {reinterpret_cast<const char*>(data) + 2, length});
    data += 2 + length;
    size -= 2 + length;
  }
  return 0;
}
