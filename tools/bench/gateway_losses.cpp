#include "tools/bench/gateway_losses.h"

#include <csignal>
#include <optional>

#include "common/wall_clock.h"

namespace nao::bench {
namespace {

/** Times until a phone is notified that a component hangs, and that it is available again, s. */
struct LossTimes {
  double told_s = 0;
  double back_s = 0;
};

LossTimes time_loss(GatewayStack& stack, WireClient& phone, const std::string& program,
                    naoremote::Notice::Component component) {
  std::optional<bool> is_available;
  stack.watch(&phone, [&](const naoremote::ServerMessage& message, double) {
    if (message.has_notice() && message.notice().kind() == naoremote::Notice::COMPONENT_CHANGED &&
        message.notice().component() == component) {
      is_available = message.notice().is_available();
    }
  });
  const auto time_until = [&](bool expected, int signal) {
    kill(stack.program(program).pid(), signal);
    const double start = monotonic_seconds();
    double next_ping = 0;
    stack.run_until(
        [&] {
          if (monotonic_seconds() > next_ping) {
            naoremote::Request ping;
            ping.mutable_ping();
            phone.send(ping);
            next_ping = monotonic_seconds() + 1;
          }
          return is_available == expected;
        },
        "the client is notified of " + program);
    return monotonic_seconds() - start;
  };
  LossTimes times;
  times.told_s = time_until(false, SIGSTOP);
  times.back_s = time_until(true, SIGCONT);
  stack.forget_clients();
  return times;
}

}  // namespace

void measure_losses(GatewayStack& stack, std::vector<Figure>& figures) {
  const auto phone = connect_tcp(stack.tcp_port());
  phone->send(connect_request("bench"));
  const auto measure = [&](const std::string& program, naoremote::Notice::Component component,
                           double image_rate, const std::string& name) {
    naoremote::Request request;
    request.mutable_subscribe()->set_state_rate(30);
    request.mutable_subscribe()->set_image_rate(image_rate);
    phone->send(request);
    stack.watch(phone.get(), [](const auto&, double) {});
    // A camera renders for 2 s after its last request.
    stack.run_for(3);
    stack.forget_clients();
    const LossTimes times = time_loss(stack, *phone, program, component);
    figures.push_back({"gateway.told_of_lost_" + name + "_s", times.told_s, "s", "promised", 2});
    figures.push_back(
        {"gateway.told_of_lost_" + name + "_s.back", times.back_s, "s", "promised", 2});
  };
  measure("nao-head-camera", naoremote::Notice::CAMERA, 15, "camera");
  measure("nao-head-camera", naoremote::Notice::CAMERA, 0, "unwatched_camera");
  measure("nao-motion", naoremote::Notice::MOTION, 15, "motion");
  measure("nao-sim", naoremote::Notice::ROBOT, 15, "robot");
}

}  // namespace nao::bench
