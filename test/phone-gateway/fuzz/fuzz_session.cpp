// Any messages of two connections, one of them from another host, into the gateway's core, with a
// robot that answers. Input: for each message one byte of what happens besides, one byte of length,
// the message.
#include <google/protobuf/stubs/logging.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "phone-gateway/server/gateway_core.h"
#include "test/phone-gateway/server/test_robot.h"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

/** What must hold of every command, whatever a client sent. */
void check(const nao::NumberedCommand& sent) {
  require(sent.command_id != 0 && !sent.source.empty());
  if (const auto* walk = std::get_if<nao::WalkVelocity>(&sent.command)) {
    require(std::abs(walk->vx) <= 0.2 && std::abs(walk->vy) <= 0.15 && std::abs(walk->wz) <= 1);
  } else if (const auto* posture = std::get_if<nao::PostureGoal>(&sent.command)) {
    require(posture->speed > 0 && posture->speed <= 1);
  } else if (const auto* change = std::get_if<nao::JointChange>(&sent.command)) {
    require(change->joint_names.size() == change->change.size());
    for (const double value : change->change) require(std::isfinite(value));
  } else if (const auto* goal = std::get_if<nao::RelativeGoal>(&sent.command)) {
    require(std::isfinite(goal->x) && std::isfinite(goal->y) && std::isfinite(goal->theta));
  }
}

class Scene {
 public:
  Scene()
      : core_(nao::make_test_robot(), nao::GatewayLimits{}, {"0.1.0", "k", "phone.1", 1},
              {[this](const nao::NumberedCommand& command) {
                 check(command);
                 last_ = command;
               },
               [](const nao::AuditEvent&) {}}) {
    for (int i = 0; i < 2; ++i) open(i);
  }

  void play(uint8_t action, std::string_view message) {
    const int who = action & 1;
    (void)core_.receive(ids_[who], message, now_);
    if ((action & 2) != 0) pass();
    if ((action & 4) != 0) collect(who);
    if ((action & 8) != 0 && last_.command_id != 0) {
      core_.add_result({last_.source, last_.command_id,
                        static_cast<nao::CommandStatus>((action >> 4) % 5), "because"},
                       now_);
    }
    if (core_.is_closing(ids_[who])) {
      collect(who);
      core_.closed(ids_[who], "fuzz", now_);
      open(who);
    }
  }

 private:
  void open(int who) {
    ids_[who] = core_.open(
        {who == 0 ? "127.0.0.1" : "10.0.0.1", "tcp", who == 0}, [] {}, now_);
  }
  void pass() {
    now_ += 0.2;
    core_.set_motion({nao::Mode::kHolding, "", {}, -1, {}, 1}, now_);
    core_.set_robot({static_cast<int64_t>(now_ * 1e6), {0, 0, 0, 0}, {1, 0, 0, 0}, {}}, now_);
    nao::StoredImage image;
    image.camera = "top";
    image.width = 320;
    image.jpeg = "jpeg";
    core_.add_image(image, now_);
    core_.step(now_);
  }
  void collect(int who) {
    while (core_.next_message(ids_[who], now_)) {
    }
  }

  double now_ = 100;
  uint32_t ids_[2] = {};
  nao::NumberedCommand last_;
  nao::GatewayCore core_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  google::protobuf::SetLogHandler(nullptr);
  Scene scene;
  while (size >= 2) {
    const uint8_t action = data[0];
    const size_t length = std::min<size_t>(data[1], size - 2);
    scene.play(action, {reinterpret_cast<const char*>(data) + 2, length});
    data += 2 + length;
    size -= 2 + length;
  }
  return 0;
}
