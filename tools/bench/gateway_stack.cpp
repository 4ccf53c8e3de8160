#include "tools/bench/gateway_stack.h"

#include <poll.h>

#include <algorithm>
#include <naolcm/daemon_status_t.hpp>
#include <naolcm/joint_command_t.hpp>
#include <naolcm/robot_state_t.hpp>
#include <naolcm/sensor_state_t.hpp>
#include <stdexcept>

#include "common/channels.h"
#include "common/wall_clock.h"
#include "tools/bench/deadline.h"
#include "tools/bench/ports.h"

namespace nao::bench {
namespace {

/** Number of states whose times are kept. Chosen: 10 s of them, longer than any message needs to
 * reach a client. */
constexpr size_t kMaxStateTimes = 1000;

template <class Message>
std::optional<double> head_yaw(const Message& message) {
  for (int i = 0; i < message.num_joints; ++i) {
    if (message.joint_names[i] == "HeadYaw") return message.joint_position[i];
  }
  return std::nullopt;
}

}  // namespace

naoremote::Request connect_request(const std::string& name) {
  naoremote::Request request;
  request.set_request_id(1);
  request.mutable_connect()->set_protocol_version(1);
  request.mutable_connect()->set_client_name(name);
  return request;
}

GatewayStack::GatewayStack(const std::string& lcm_url,
                           const std::vector<std::string>& gateway_options)
    : bus_(lcm_url) {
  const std::string folder = program_folder();
  const auto start = [&](const std::string& name, std::vector<std::string> options) {
    std::vector<std::string> command = {folder + "/" + name, "--lcm-url", lcm_url};
    command.insert(command.end(), options.begin(), options.end());
    programs_[name] = std::make_unique<ChildProcess>(command);
  };
  subscribe();
  start("nao-sim", {});
  start("nao-motion", {});
  start("nao-head-camera", {});
  std::vector<std::string> options = {"--bind",     "127.0.0.1", "--http-port", "0",
                                      "--tcp-port", "0",         "--token",     kToken};
  if (!gateway_options.empty()) options = gateway_options;
  start("nao-phone-gateway", options);
  run_until([this] { return ready_.size() == programs_.size(); }, "every program is ready");
  http_port_ = wait_for_port(gateway(), "WebSocket on ");
  tcp_port_ = wait_for_port(gateway(), "TCP on ");
  run_for(1);
}

void GatewayStack::watch(WireClient* client, Handler handler) {
  clients_.push_back({client, std::move(handler)});
}

void GatewayStack::run_until(const std::function<bool()>& is_done, const std::string& what) {
  const double deadline = monotonic_seconds() + kDeadline;
  while (!is_done()) {
    if (monotonic_seconds() > deadline) throw std::runtime_error("timed out before " + what);
    pump(0.1);
  }
}

void GatewayStack::run_for(double time) {
  const double deadline = monotonic_seconds() + time;
  while (monotonic_seconds() < deadline) pump(deadline - monotonic_seconds());
}

std::optional<double> GatewayStack::time_of_state(uint64_t utime) const {
  const auto found = state_times_.find(static_cast<int64_t>(utime));
  return found == state_times_.end() ? std::nullopt : std::optional(found->second);
}

void GatewayStack::subscribe() {
  const RobotChannels channels;
  bus_.subscribe<naolcm::joint_command_t>(channels.joint_command, Bus::Queue::kAll,
                                          [this](const auto& message) {
                                            if (const auto angle = head_yaw(message))
                                              yaw_target = *angle;
                                            yaw_target_time = monotonic_seconds();
                                          });
  bus_.subscribe<naolcm::sensor_state_t>(channels.sensor_state, Bus::Queue::kAll,
                                         [this](const auto& message) {
                                           const double last = yaw;
                                           if (const auto angle = head_yaw(message)) yaw = *angle;
                                           yaw_time = monotonic_seconds();
                                           if (yaw != last) yaw_still_since = yaw_time;
                                         });
  bus_.subscribe<naolcm::robot_state_t>(channels.robot_state, Bus::Queue::kAll,
                                        [this](const auto& message) {
                                          state_times_[message.utime] = monotonic_seconds();
                                          if (state_times_.size() > kMaxStateTimes)
                                            state_times_.erase(state_times_.begin());
                                        });
  bus_.subscribe<naolcm::daemon_status_t>(kDaemonStatusChannel, Bus::Queue::kAll,
                                          [this](const auto& message) {
                                            if (message.state == "ready")
                                              ready_.insert(message.program);
                                          });
}

/** Handles what has arrived from the bus and the clients, waiting at most this long for it, s. */
void GatewayStack::pump(double timeout) {
  std::vector<pollfd> polled = {{bus_.descriptor(), POLLIN, 0}};
  for (const Watched& watched : clients_) {
    polled.push_back({watched.client->descriptor(), POLLIN, 0});
  }
  poll(polled.data(), polled.size(), std::max(0, static_cast<int>(timeout * 1e3)));
  if (polled[0].revents != 0) bus_.handle();
  // All messages are read before any is decoded, so that no phone waits until another has decoded.
  std::vector<double> times(polled.size());
  for (size_t i = 1; i < polled.size(); ++i) {
    if (polled[i].revents == 0) continue;
    clients_[i - 1].client->read();
    times[i] = monotonic_seconds();
  }
  for (size_t i = 1; i < polled.size(); ++i) {
    if (polled[i].revents == 0) continue;
    for (const auto& message : clients_[i - 1].client->take_messages()) {
      clients_[i - 1].handler(message, times[i]);
    }
  }
}

}  // namespace nao::bench
