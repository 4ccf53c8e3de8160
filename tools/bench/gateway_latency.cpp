#include "tools/bench/gateway_latency.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <naolcm/joint_change_command_t.hpp>
#include <random>

#include "common/channels.h"
#include "common/wall_clock.h"

namespace nao::bench {
namespace {

/** Change of the head yaw, rad. Chosen: executed within half a second, far from the limits. */
constexpr double kYawChange = 0.4;
/** The joint has moved when its encoder (steps of 0.0015 rad, no other noise) reads the next step
 * on the way to the goal. Before that, the reading must be constant for this time, s. */
constexpr double kMoved = 0.001;
constexpr double kStillTime = 0.2;
/** The simulator's control tick, s. */
constexpr double kTick = 0.01;

/** Times from the request of a joint's change to the events that follow, ms. */
struct Latency {
  /** Time to the next measurement: no command is processed earlier. */
  std::vector<double> to_tick_ms;
  std::vector<double> to_command_ms;
  std::vector<double> to_moved_ms;
};

/** Turns the head and times the events that follow. @param ask  Sends the change, rad.
 * @param phase  Time of the request after a measurement, s, in [0, kTick]. */
void time_change(GatewayStack& stack, const std::function<void(double)>& ask, double change,
                 double phase, Latency& times) {
  const double heard_before = stack.yaw_time;
  stack.run_until(
      [&] {
        return stack.yaw_time > heard_before && stack.yaw_time - stack.yaw_still_since > kStillTime;
      },
      "the head is at rest");
  stack.run_for(phase);
  const double target_before = stack.yaw_target;
  const double yaw_before = stack.yaw;
  const double direction = change > 0 ? 1 : -1;
  const double start = monotonic_seconds();
  ask(change);
  double tick_time = 0;
  double command_time = 0;
  double moved_time = 0;
  stack.run_until(
      [&] {
        if (tick_time == 0 && stack.yaw_time > start) tick_time = stack.yaw_time;
        if (command_time == 0 && std::abs(stack.yaw_target - target_before) > 1e-6) {
          command_time = stack.yaw_target_time;
        }
        if (moved_time == 0 && (stack.yaw - yaw_before) * direction > kMoved) {
          moved_time = stack.yaw_time;
        }
        return command_time > 0 && moved_time > 0;
      },
      "the head turns");
  times.to_tick_ms.push_back((tick_time - start) * 1e3);
  times.to_command_ms.push_back((command_time - start) * 1e3);
  times.to_moved_ms.push_back((moved_time - start) * 1e3);
}

/** Moments of the control tick, one in each of `num` equal parts of it, in random order, s. The
 * median over phases drawn freely would scatter by 0.8 ms with 40 of them. */
std::vector<double> tick_phases(int num, std::mt19937& random) {
  std::uniform_real_distribution<double> within_part(0, 1);
  std::vector<double> phases;
  for (int i = 0; i < num; ++i) phases.push_back((i + within_part(random)) / num * kTick);
  std::shuffle(phases.begin(), phases.end(), random);
  return phases;
}

/** A command goes over raw TCP, over WebSocket, and directly on the bus without a gateway: in turn,
 * at the same moments of the control tick. */
std::map<std::string, Latency> measure_paths(GatewayStack& stack, int num_rounds) {
  const auto tcp = connect_tcp(stack.tcp_port());
  const auto websocket = connect_websocket(stack.http_port());
  for (WireClient* client : {tcp.get(), websocket.get()}) {
    client->send(connect_request("bench"));
    stack.watch(client, [](const auto&, double) {});
  }
  const auto ask_phone = [](WireClient& client) {
    return [&client](double change) {
      naoremote::Request request;
      request.mutable_change_joints()->set_group("head");
      request.mutable_change_joints()->set_yaw(change);
      request.mutable_change_joints()->set_speed(1);
      client.send(request);
    };
  };
  int64_t command_id = wall_utime();
  const auto ask_bus = [&](double change) {
    naolcm::joint_change_command_t command{};
    command.source = "bench." + std::to_string(getpid());
    command.command_id = ++command_id;
    command.num_joints = 1;
    command.joint_names = {"HeadYaw"};
    command.joint_position = {change};
    command.joint_stiffness = {std::numeric_limits<double>::quiet_NaN()};
    command.is_relative = 1;
    command.speed = 1;
    stack.bus().publish(RobotChannels().joint_change_command, command);
  };
  const std::vector<std::pair<std::string, std::function<void(double)>>> ways = {
      {"tcp", ask_phone(*tcp)}, {"websocket", ask_phone(*websocket)}, {"bus", ask_bus}};

  std::map<std::string, Latency> times;
  std::map<std::string, std::vector<double>> phases;
  std::mt19937 random(1);
  for (const auto& [name, ask] : ways) phases[name] = tick_phases(num_rounds, random);
  // Time between two commands, s: the motion of one has ended before the next.
  constexpr double kPause = 0.3;
  double change = kYawChange;
  for (int round = 0; round < num_rounds; ++round) {
    for (const auto& [name, ask] : ways) {
      WireClient* driver = name == "tcp"         ? tcp.get()
                           : name == "websocket" ? websocket.get()
                                                 : nullptr;
      naoremote::Request request;
      request.mutable_take_control();
      if (driver != nullptr) driver->send(request);
      stack.run_for(kPause);
      time_change(stack, ask, change, phases[name][static_cast<size_t>(round)], times[name]);
      change = -change;
      stack.run_for(kPause);
      request.mutable_release_control();
      if (driver != nullptr) driver->send(request);
      // Both connections stay alive.
      request.mutable_ping();
      tcp->send(request);
      websocket->send(request);
    }
  }
  stack.forget_clients();
  return times;
}

}  // namespace

void measure_command_latency(GatewayStack& stack, int num_rounds, std::vector<Figure>& figures) {
  auto ways = measure_paths(stack, num_rounds);
  for (const auto& [name, suffix] : {std::pair{"tcp", ""}, std::pair{"websocket", ".websocket"}}) {
    for (const auto& [share, word] : {std::pair{0.5, "p50"}, std::pair{0.99, "p99"}}) {
      const std::string end = std::string(suffix) + "." + word;
      figures.push_back({"gateway.to_joint_command_ms" + end,
                         percentile(ways[name].to_command_ms, share), "ms", "straight on the bus",
                         percentile(ways["bus"].to_command_ms, share)});
      figures.push_back({"gateway.to_moved_joint_ms" + end,
                         percentile(ways[name].to_moved_ms, share), "ms", "straight on the bus",
                         percentile(ways["bus"].to_moved_ms, share)});
    }
  }

  std::vector<double> to_tick;
  for (const auto& [name, way] : ways) {
    to_tick.insert(to_tick.end(), way.to_tick_ms.begin(), way.to_tick_ms.end());
  }
  figures.push_back(
      {"gateway.to_tick_ms.p50", percentile(to_tick, 0.5), "ms", "half of a 10 ms tick", 5});
  figures.push_back({"gateway.to_tick_ms.p99", percentile(to_tick, 0.99), "ms", "a tick", 10});
}

}  // namespace nao::bench
